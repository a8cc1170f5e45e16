# SPDX-License-Identifier: MIT
"""Checks benchmarks/thin_svg: what it keeps of a file as matplotlib writes it. thin_svg_check.py BENCHMARKS_FOLDER"""
import math
import re
import sys

sys.path.insert(0, sys.argv[1])

import thin_svg
from thin_svg.geometry import TOLERANCE, parse_path, simplified


def expect(condition, what, *shown):
    if not condition:
        sys.exit(f"thin_svg_check.py: {what}: {shown}")


def distance(point, start, end):
    (x, y), (dx, dy) = (point[0] - start[0], point[1] - start[1]), (end[0] - start[0], end[1] - start[1])
    along = min(max((x * dx + y * dy) / (dx * dx + dy * dy), 0), 1)
    return math.hypot(x - along * dx, y - along * dy)


def check_simplified():
    line = [(0.25 * i, 20 * math.sin(0.02 * i)) for i in range(1000)]
    few = simplified(line)
    expect(few[0] == line[0] and few[-1] == line[-1], "the ends stay", few)
    expect(len(few) < 100, "a smooth line needs few points", len(few))
    worst = max(min(distance(point, a, b) for a, b in zip(few, few[1:])) for point in line)
    expect(worst <= TOLERANCE, "every point is near the line", worst)
    spike = [(0.0, 0.0), (1.0, 0.0), (1.1, 5.0), (1.2, 0.0), (2.0, 0.0)]
    expect((1.1, 5.0) in simplified(spike), "a spike stays", simplified(spike))


def picture(body):
    return ('<svg xmlns:xlink="http://www.w3.org/1999/xlink" width="90pt" height="60pt" viewBox="0 0 90 60" '
            f'xmlns="http://www.w3.org/2000/svg"><metadata></metadata>{body}</svg>')


def path(d, style):
    return f'<path d="{d}" style="{style}"/>'


def check_file():
    red, blue = "fill: none; stroke: #ff0000", "fill: none; stroke: #0000ff; stroke-opacity: 0.5"
    text = thin_svg.thin(picture(
        path("M 0 0 L 9.04 0", red) + path("M 0 5 L 9 5.5", red)
        + path("M 0 0 L 8 8", blue) + path("M 8 0 L 0 8", blue)
        + '<text style="font-size: 9px; text-anchor: middle" x="4.44" y="5" transform="rotate(-0 4.44 5)">a &lt; b</text>'
        + '<defs><path id="m1" d="M 0 1 C 1 1 2 2 3 3 C 1 1 2 2 3 4 z"/></defs>'
        + '<use xlink:href="#m1" x="1" y="2" style="fill: #00ff00"/><use xlink:href="#m1" x="5" y="6.06" style="fill: #00ff00"/>'))
    expect('d="M0 0h9M0 5l9 .5"' in text, "lines of one style are one path, rounded", text)
    expect('"M0 0l8 8"' in text and '"M8 0l-8 8"' in text, "transparent lines that cross stay apart", text)
    expect('>a &lt; b</text>' in text and "text-anchor:middle" in text, "text", text)
    expect(re.search(r'<use href="#_a" x="1" y="2"/>\s*<use href="#_a" x="5" y="6.1"/>', text), "markers", text)
    expect(thin_svg.thin(text) == text, "a thin file stays as it is", text)


def check_parse():
    expect(parse_path("M 1 2 \nL 3 4 \nz\nM 5 6") == [[("M", [(1, 2)]), ("L", [(3, 4)]), ("z", [])], [("M", [(5, 6)])]],
           "a path of two parts", parse_path("M 1 2 \nL 3 4 \nz\nM 5 6"))


check_simplified()
check_parse()
check_file()

# SPDX-License-Identifier: MIT
"""Paths of SVG files: parsed, simplified and written in few letters."""
import re

TOLERANCE = 0.2  # pt, of lines


def simplified(points):
    """Without the points that are within TOLERANCE of the line between their neighbours that are kept."""
    kept, open_parts = {0, len(points) - 1}, [(0, len(points) - 1)]
    while open_parts:
        first, last = open_parts.pop()
        (x0, y0), (x1, y1) = points[first], points[last]
        dx, dy = x1 - x0, y1 - y0
        square = dx * dx + dy * dy
        worst, worst_distance = first, TOLERANCE**2
        for i in range(first + 1, last):
            x, y = points[i][0] - x0, points[i][1] - y0
            along = min(max((x * dx + y * dy) / square, 0), 1) if square else 0
            distance = (x - along * dx) ** 2 + (y - along * dy) ** 2
            if distance > worst_distance:
                worst, worst_distance = i, distance
        if worst != first:
            kept.add(worst)
            open_parts += (first, worst), (worst, last)
    return [points[i] for i in sorted(kept)]


def parse_path(text):
    """Subpaths, each a list of (command, points) with absolute coordinates; z has no points."""
    subpaths = []
    for command, numbers in re.findall(r"([MLQCz])([^MLQCz]*)", text):
        values = [float(value) for value in numbers.split()]
        points = list(zip(values[::2], values[1::2]))
        if command == "M":
            subpaths.append([("M", points)])
        else:
            subpaths[-1].append((command, points))
    return subpaths


def thinned(subpath):
    """The subpath with its runs of straight lines simplified."""
    result, run = [], []
    for command, points in [*subpath, ("", [])]:
        if command in ("M", "L"):
            run += points
            continue
        if run:
            run = simplified(run)
            start = 1 if result else 0
            result += [("M", run[:1])][start:] + ([("L", run[1:])] if run[1:] else [])
        if command:
            result.append((command, points))
        run = points[-1:] if command in ("Q", "C") else []
    return result


def compact(value):
    """Without zeros and points that a number can do without."""
    text = f"{value:.2f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text.replace("0.", ".", 1) if re.match(r"-?0\.", text) else text


def joined(numbers):
    """Numbers, separated where they have to be."""
    text = ""
    for number in map(compact, numbers):
        text += number if not text or number[0] == "-" else " " + number
    return text


def path_text(subpaths, digits):
    """The attribute d: relative, with coordinates rounded to so many digits."""
    text, x, y = "", 0.0, 0.0
    for subpath in subpaths:
        for command, points in subpath:
            rounded = [(round(px, digits), round(py, digits)) for px, py in points]
            if command == "z":
                text += "z"
            elif command == "M":
                (x, y), = rounded
                text += "M" + joined((x, y)) + ("h0" if len(subpath) == 1 else "")
                start = x, y
            elif command == "L":
                text += line_text(x, y, rounded)
            else:
                moves = [(px - x, py - y) for px, py in rounded]
                text += command.lower() + joined([value for move in moves for value in move])
            if rounded:
                x, y = rounded[-1]
        if subpath[-1][0] == "z":
            x, y = start
    return text


def line_text(x, y, points):
    text, before = "", ""
    for px, py in points:
        dx, dy = round(px - x, 2), round(py - y, 2)
        x, y = px, py
        if not dx and not dy:
            continue
        command = "h" if not dy else "v" if not dx else "l"
        numbers = joined((dx, dy)) if command == "l" else compact(dx or dy)
        text += command + numbers if command != before else (numbers if numbers[0] == "-" else " " + numbers)
        before = command
    return text or "h0"


def disc_radius(subpaths):
    """The radius of a marker that is a disc about the origin; 0 of others. A disc can be a dot with round ends."""
    if [command for subpath in subpaths for command, _ in subpath] != ["M", *8 * "C", "z"]:
        return 0
    distances = {round((x * x + y * y) ** 0.5, 2) for _, points in subpaths[0] for x, y in points[-1:]}
    return distances.pop() if len(distances) == 1 else 0

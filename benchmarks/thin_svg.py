#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Rewrites SVG files of matplotlib in about a tenth of their bytes. They look the same.

    thin_svg.py PICTURE.svg …        # rewrites the files; the plotting scripts here call save() instead

Coordinates are rounded to 0.1 pt. Lines lose the points that are within 0.2 pt of the line without them
(Douglas and Peucker 1973). Neighbouring elements of the same style become one element, and styles become classes.
Write the figure with the setting svg.fonttype "none", because outlines of letters are not thinned."""

import io
import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree
from xml.sax.saxutils import escape

SVG, XLINK = "{http://www.w3.org/2000/svg}", "{http://www.w3.org/1999/xlink}"
TOLERANCE = 0.2  # pt, of lines
COLOUR_STEP = 12  # of 255: colours along a line that differ by less become one
FONTS = "DejaVu Sans,Verdana,sans-serif"
BLACK = "#000000"
LINE_LENGTH = 118


# ------------------------------------------------------------------------------------------------ geometry

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


# ------------------------------------------------------------------------------------------------ reading

def parse_style(text):
    return dict(re.split(r":\s*", part, maxsplit=1) for part in re.split(r";\s*", text or "") if part)


class Item:
    """What is drawn: kind is path, use, text or image; data depends on it. Items of a layer may be drawn in any order."""

    def __init__(self, kind, style, clip, layer, data):
        self.kind, self.style, self.clip, self.layer, self.data = kind, style, clip, layer, data

    def key(self):
        return self.kind, tuple(self.style.items()), self.clip


class Reader:
    """Reads a file of matplotlib into items, in the order in which they are drawn."""

    def __init__(self, text):
        self.root = ElementTree.fromstring(text)
        self.items, self.clips, self.shapes = [], {}, {}
        for element in self.root.iter(SVG + "clipPath"):
            rectangle = element.find(SVG + "rect")
            self.clips[element.get("id")] = [float(rectangle.get(name)) for name in ("x", "y", "width", "height")]
        self.uses = [element.get(XLINK + "href")[1:] for element in self.root.iter(SVG + "use")]
        for definitions in self.root.iter(SVG + "defs"):
            for path in definitions.iter(SVG + "path"):
                self.shapes[path.get("id")] = path
        for child in self.root:
            self.read(child, None, None)

    def read(self, element, clip, layer):
        tag = element.tag.removeprefix(SVG)
        if tag in ("defs", "metadata", "style"):
            return
        found = re.match(r"url\(#(.*)\)", element.get("clip-path", ""))
        clip = found[1] if found else clip
        style = parse_style(element.get("style"))
        if tag == "g":
            if element.get("id", "").startswith(("matplotlib.axis", "LineCollection")):
                layer = element.get("id")
            child = element[0] if len(element) == 1 else None
            if child is not None and child.tag == SVG + "text" and element.get("transform"):
                self.read_text(child, element.get("transform"), layer)
                return
            for child in element:
                self.read(child, clip, layer)
        elif tag == "path":
            self.items.append(Item("path", style, clip, layer, parse_path(element.get("d"))))
        elif tag == "use":
            self.read_use(element, style, clip, layer)
        elif tag == "text":
            self.read_text(element, element.get("transform", ""), layer)
        elif tag == "image":
            self.items.append(Item("image", {}, clip, layer, dict(element.items())))
        else:
            sys.exit(f"thin_svg.py: <{tag}>: expected an element as matplotlib writes it")

    def read_use(self, element, style, clip, layer):
        name = element.get(XLINK + "href")[1:]
        shape = self.shapes[name]
        style = {**style, **parse_style(shape.get("style"))}
        x, y = float(element.get("x", 0)), float(element.get("y", 0))
        subpaths = parse_path(shape.get("d"))
        radius = disc_radius(subpaths)
        if radius and style.get("fill", BLACK) == style.get("stroke") and not any("opacity" in name for name in style):
            width = 2 * radius + float(style.get("stroke-width", 1))
            style = {"fill": "none", "stroke": style["stroke"], "stroke-width": compact(width), "stroke-linecap": "round"}
            self.items.append(Item("path", style, clip, layer, [[("M", [(x, y)])]]))
        elif self.uses.count(name) == 1 or (len(subpaths) == 1 and sum(len(points) for _, points in subpaths[0]) < 6):
            moved = [[(command, [(px + x, py + y) for px, py in points]) for command, points in subpath]
                     for subpath in subpaths]
            self.items.append(Item("path", style, clip, layer, moved))
        else:
            self.items.append(Item("use", style, clip, layer, (name, x, y)))

    def read_text(self, element, transform, layer):
        """Text with parts (x, y, style, letters): one, or those of a formula."""
        move = re.match(r"translate\(([-\d.]+) ([-\d.]+)\)", transform)
        turn = re.search(r"rotate\(([-\d.]+)", transform)
        origin = tuple(map(float, move.groups())) if move else (float(element.get("x")), float(element.get("y")))
        parts = []
        for span in element.findall(SVG + "tspan"):
            style, x, y = text_style(span.get("style")), float(span.get("x").split()[0]), float(span.get("y"))
            if parts and parts[-1][1:3] == (y, style):
                parts[-1] = (*parts[-1][:3], parts[-1][3] + span.text)
            else:
                parts.append((x, y, style, span.text))
        own = text_style(element.get("style"))
        parts = parts or [(0.0, 0.0, own, element.text)]
        self.items.append(Item("text", parts[0][2], None, layer, (origin, float(turn[1]) if turn else 0.0, parts)))


def text_style(text):
    """Without the fonts, which are the same for all, and the anchor that is the default."""
    style = parse_style(text)
    style.pop("font-family", None)
    if style.get("text-anchor") == "start":
        del style["text-anchor"]
    return style


# ------------------------------------------------------------------------------------------------ joining

def near_colours(a, b):
    return all(abs(int(a[i:i + 2], 16) - int(b[i:i + 2], 16)) < COLOUR_STEP for i in (1, 3, 5))


def join_segments(items):
    """Segments of a line whose colour changes along it: one line as long as the colour is nearly the same."""
    result, palette = [], []
    for item in items:
        before = result[-1] if result else None
        if item.layer and item.layer.startswith("LineCollection") and item.kind == "path":
            colour = item.style["stroke"]
            item.style["stroke"] = next((known for known in palette if near_colours(known, colour)), colour)
            palette += [] if item.style["stroke"] in palette else [colour]
            if before and item.layer == before.layer and item.key() == before.key() \
                    and before.data[-1][-1][1][-1] == item.data[0][0][1][0]:
                before.data[-1] += item.data[0][1:]
                before.data += item.data[1:]
                continue
        result.append(item)
    return result


def box(item):
    points = [point for subpath in item.data for _, points in subpath for point in points]
    xs, ys = zip(*points)
    border = float(item.style.get("stroke-width", 1)) / 2 if "stroke" in item.style else 0
    return min(xs) - border, min(ys) - border, max(xs) + border, max(ys) + border


def can_be_one(items, item):
    """Whether paths of the same style look the same as one path: opaque lines always, others where they are apart."""
    if item.style.get("fill") == "none" and "stroke-opacity" not in item.style and "opacity" not in item.style:
        return True
    left, top, right, bottom = box(item)
    return all(other[2] < left or right < other[0] or other[3] < top or bottom < other[1] for other in map(box, items))


def grouped(items):
    """Groups of items with the same key: neighbours, and all of an axis."""
    groups = []
    for item in items:
        for group in reversed(groups):
            if group[0].key() == item.key() and (item.kind != "path" or item.layer or can_be_one(group, item)):
                group.append(item)
                break
            if item.layer is None or group[0].layer != item.layer:
                groups.append([item])
                break
        else:
            groups.append([item])
    return groups


# ------------------------------------------------------------------------------------------------ writing

class Writer:
    """Writes groups of items. Names of classes and shapes are as short as can be."""

    def __init__(self, reader):
        self.reader, self.classes, self.names = reader, {}, {}

    @staticmethod
    def short(names, key):
        """The name of a key: a … z, a1 … z1, …"""
        number = names.setdefault(key, len(names))
        return chr(ord("a") + number % 26) + (str(number // 26) if number >= 26 else "")

    def class_of(self, style):
        text = ";".join(f"{name}:{value.replace(', ', ',')}" for name, value in style.items() if value != "butt")
        return f' class="{self.short(self.classes, text)}"' if text else ""

    def name_of(self, old):
        return "_" + self.short(self.names, old)

    def elements(self, group):
        kind, style = group[0].kind, self.class_of(group[0].style)
        if kind == "path":
            d = path_text([thinned(subpath) for item in group for subpath in item.data], 1)
            return [f'<path{style} d="{d}"/>']
        if kind == "use":
            uses = [f'<use href="#{self.name_of(name)}" x="{compact(round(x, 1))}" y="{compact(round(y, 1))}"/>'
                    for name, x, y in (item.data for item in group)]
            return [f"<g{style}>", *uses, "</g>"]
        if kind == "text":
            texts = [self.text(*item.data) for item in group]
            return [f"<g{style}>", *texts, "</g>"]
        return [self.image(item.data) for item in group]

    def text(self, origin, turn, parts):
        def place(x, y):
            return f' x="{compact(round(x, 1))}" y="{compact(round(y, 1))}"'
        x0, y0 = origin
        written = f' transform="rotate({compact(turn)} {compact(round(x0, 1))} {compact(round(y0, 1))})"' if turn else ""
        x, y, base, letters = parts[0]
        written = f"<text{place(x0 + x, y0 + y)}{written}>{escape(letters)}"
        for x, y, style, letters in parts[1:]:
            own = self.class_of(style) if style != base else ""
            written += f"<tspan{own}{place(x0 + x, y0 + y)}>{escape(letters)}</tspan>"
        return written + "</text>"

    @staticmethod
    def image(attributes):
        written = " ".join(f'{name.replace(XLINK, "")}="{"".join(value.split()) if "href" in name else value}"'
                           for name, value in attributes.items() if name != "id")
        return f"<image {written}/>"

    def document(self, groups):
        body, clip = [], None
        for group in groups:
            if group[0].clip != clip:
                body += ["</g>"] if clip else []
                clip = group[0].clip
                body += [f'<g clip-path="url(#{self.name_of(clip)})">'] if clip else []
            body += self.elements(group)
        body += ["</g>"] if clip else []
        shapes = []
        for old in self.names:
            name = self.name_of(old)
            if old in self.reader.clips:
                x, y, width, height = (compact(round(value, 1)) for value in self.reader.clips[old])
                shapes.append(f'<clipPath id="{name}"><rect x="{x}" y="{y}" width="{width}" height="{height}"/></clipPath>')
            else:
                d = path_text(parse_path(self.reader.shapes[old].get("d")), 2)
                shapes.append(f'<path id="{name}" d="{d}"/>')
        root = self.reader.root
        size = " ".join(f'{name}="{root.get(name)}"' for name in ("width", "height", "viewBox"))
        classes = [f".{self.short(self.classes, text)}{{{text}}}" for text in self.classes]
        return [f'<svg xmlns="http://www.w3.org/2000/svg" {size}',
                f' font-family="{FONTS}" stroke-linejoin="round">', "<style>", *classes, "</style>", "<defs>", *shapes, "</defs>", *body, "</svg>"]


def lines_of(elements):
    """Elements in lines of at most LINE_LENGTH letters. Longer elements are broken where a number begins."""
    lines = [""]
    for element in elements:
        breakable = element.startswith("<path")
        if len(lines[-1]) + len(element) > LINE_LENGTH and lines[-1]:
            lines.append("")
        lines[-1] += element
        while breakable and len(lines[-1]) > LINE_LENGTH:
            at = max(lines[-1].rfind(letter, 20, LINE_LENGTH) for letter in " -hvlMz")
            if at < 0:
                break
            lines[-1:] = [lines[-1][:at], lines[-1][at:].lstrip(" ")]
    return lines


def thin(text):
    """The text of an SVG file of matplotlib, thinned. A file that is thin already is returned as it is."""
    if "<metadata>" not in text:
        return text
    reader = Reader(text)
    groups = grouped(join_segments(reader.items))
    return "\n".join(lines_of(Writer(reader).document(groups))) + "\n"


def save(figure, path):
    """Writes the figure; svg thinned, and the same bytes for the same figure."""
    path = pathlib.Path(path)
    if path.suffix != ".svg":
        figure.savefig(path, dpi=130)
        return
    import matplotlib
    with matplotlib.rc_context({"svg.hashsalt": "splinertia", "svg.fonttype": "none"}):
        text = io.StringIO()
        figure.savefig(text, format="svg", metadata={"Date": None})
    path.write_text(thin(text.getvalue()), encoding="utf-8")


def main():
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    for path in map(pathlib.Path, sys.argv[1:]):
        path.write_text(thin(path.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()

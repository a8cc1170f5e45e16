# SPDX-License-Identifier: MIT
"""Reads an SVG file of matplotlib into items, in the order in which they are drawn."""
import re
import sys
import xml.etree.ElementTree as ElementTree

from .geometry import compact, disc_radius, parse_path

SVG, XLINK = "{http://www.w3.org/2000/svg}", "{http://www.w3.org/1999/xlink}"
BLACK = "#000000"


def parse_style(text):
    return dict(re.split(r":\s*", part, maxsplit=1) for part in re.split(r";\s*", text or "") if part)


class Item:
    """What is drawn. The kind is path, use, text or image; data depends on it. A layer has no order."""

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
            style = {"fill": "none", "stroke": style["stroke"], "stroke-width": compact(width),
                     "stroke-linecap": "round"}
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

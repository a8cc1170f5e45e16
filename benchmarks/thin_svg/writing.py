# SPDX-License-Identifier: MIT
"""Writes groups of items as an SVG file."""
from xml.sax.saxutils import escape

from .geometry import compact, parse_path, path_text, thinned
from .reading import XLINK

FONTS = "DejaVu Sans,Verdana,sans-serif"
LINE_LENGTH = 118


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
        turned = f' transform="rotate({compact(turn)} {compact(round(x0, 1))} {compact(round(y0, 1))})"' if turn else ""
        x, y, base, letters = parts[0]
        written = f"<text{place(x0 + x, y0 + y)}{turned}>{escape(letters)}"
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
                shapes.append(f'<clipPath id="{name}"><rect x="{x}" y="{y}" width="{width}" height="{height}"/>'
                              "</clipPath>")
            else:
                d = path_text(parse_path(self.reader.shapes[old].get("d")), 2)
                shapes.append(f'<path id="{name}" d="{d}"/>')
        root = self.reader.root
        size = " ".join(f'{name}="{root.get(name)}"' for name in ("width", "height", "viewBox"))
        classes = [f".{self.short(self.classes, text)}{{{text}}}" for text in self.classes]
        return [f'<svg xmlns="http://www.w3.org/2000/svg" {size}', f' font-family="{FONTS}" stroke-linejoin="round">',
                "<style>", *classes, "</style>", "<defs>", *shapes, "</defs>", *body, "</svg>"]


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

# SPDX-License-Identifier: MIT
"""Numbers, tables and csv files of the study."""
import csv
import re
import textwrap

WIDTH = 120


def write_csv(path, columns, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)


def read_csv(path):
    """Rows as dictionaries, numbers as such, empty cells as None; no rows where there is no file."""
    def value(text):
        try:
            return float(text) if text else None
        except ValueError:
            return text
    if not path.exists():
        return []
    with open(path, newline="") as file:
        return [{key: value(text) for key, text in row.items()} for row in csv.DictReader(file)]


def number(x, digits=2):
    """So many digits that count, without exponents where that is readable."""
    if x is None:
        return ""
    if x == 0:
        return "0"
    magnitude = int(f"{x:.{digits - 1}e}".split("e")[1])  # of what is left when it is rounded
    if -4 <= magnitude < 6:
        decimals = max(0, digits - 1 - magnitude)
        return f"{round(x, digits - 1 - magnitude):.{decimals}f}"
    mantissa, exponent = f"{x:.{digits - 1}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def table(header, rows):
    lines = ["| " + " | ".join(str(cell) for cell in row) + " |" for row in [header, ["---"] * len(header), *rows]]
    return "\n".join(lines)


def spread(values, digits=2):
    smallest, middle, largest = values
    return f"{number(smallest, digits)} ({number(middle, digits)}, {number(largest, digits)})"


def reflow(page):
    """The page with its paragraphs and list items filled to the width. Headings, tables, pictures and code stay."""
    def filled(block):
        if re.match(r"[|#!]|    ", block) or "\n|" in block:
            return block
        items = re.split(r"\n(?=- )", block)
        return "\n".join(
            textwrap.fill(" ".join(item.split()), WIDTH, subsequent_indent="  " if item.startswith("- ") else "",
                          break_long_words=False, break_on_hyphens=False) for item in items)
    return "\n\n".join(filled(block) for block in page.rstrip("\n").split("\n\n")) + "\n"

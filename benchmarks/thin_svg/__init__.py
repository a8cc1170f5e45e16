# SPDX-License-Identifier: MIT
"""Rewrites SVG files of matplotlib in about an eighth of their bytes. They look the same.

    python3 benchmarks/thin_svg PICTURE.svg …        # rewrites the files; the plotting scripts here call save()

Coordinates are rounded to 0.1 pt. Lines lose the points that are within 0.2 pt of the line without them
(Douglas and Peucker 1973). Neighbouring elements of the same style become one element, and styles become classes.
Write the figure with the setting svg.fonttype "none", because outlines of letters are not thinned. docs/allan.svg and
docs/evaluation.svg are pictures of the programs allan and compare_trajectories that were rewritten by this."""
import io
import pathlib

from .joining import grouped, join_segments
from .reading import Reader
from .writing import Writer, lines_of


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

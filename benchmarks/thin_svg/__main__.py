# SPDX-License-Identifier: MIT
"""Rewrites the SVG files that are named: see __init__.py."""
import pathlib
import sys

sys.path[0] = str(pathlib.Path(__file__).resolve().parent.parent)

import thin_svg

if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
    sys.exit(thin_svg.__doc__)
for path in map(pathlib.Path, sys.argv[1:]):
    path.write_text(thin_svg.thin(path.read_text(encoding="utf-8")), encoding="utf-8")

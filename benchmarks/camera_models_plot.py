#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what camera_models has printed: camera_models_plot.py MODELS.csv [-o docs/cameras.svg]"""

import argparse
import collections
import csv

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import thin_svg

PANELS = {
    "pinhole-none": "Pinhole<NoDistortion>", "pinhole-radtan": "Pinhole<RadialTangential>",
    "pinhole-radtan8": "Pinhole<Rational>", "pinhole-equi": "Pinhole<Equidistant>", "fov": "FieldOfView",
    "omni-radtan": "Unified<RadialTangential>", "ds-none": "DoubleSphere", "eucm-none": "ExtendedUnified",
    "equirectangular": "Equirectangular"}
SIZE = 512    # of the image
MARGIN = 170  # that is drawn around it


def read(path):
    """Lines of pixels by panel, kind and value, and the angle at which each domain ends."""
    lines, ends = collections.defaultdict(list), {}
    with open(path) as file:
        for row in csv.DictReader(file):
            if row["kind"] == "end":
                ends[row["panel"]] = float(row["value"])
            else:
                lines[row["panel"], row["kind"], float(row["value"])].append((float(row["u"]), float(row["v"])))
    return {key: np.array(points) for key, points in lines.items()}, ends


def unwrapped(points):
    """The line, broken where a panorama ends on one side and begins on the other."""
    jumps = np.flatnonzero(np.abs(np.diff(points[:, 0])) > SIZE / 5) + 1
    return np.insert(points, jumps, np.nan, axis=0)


def draw_grid(axis, name, lines, end):
    border = lines[name, "border", 0]
    finite = np.all(np.abs(border) < 20 * SIZE) and name != "equirectangular"
    if finite:
        axis.set_facecolor("0.85")
        axis.fill(*border.T, color="white", zorder=0)
        axis.plot(*border.T, color="#D55E00", linewidth=1.4)
    for (panel, kind, value), points in lines.items():
        if panel != name or kind == "border":
            continue
        points = np.where(np.abs(points) < 10 * SIZE, points, np.nan)
        if name == "equirectangular" and kind == "meridian" and value % 180 == 90:
            continue  # through the poles
        right_angle = kind == "circle" and value == 90
        axis.plot(*unwrapped(points).T, color="#0072B2" if right_angle else "0.55", linewidth=1.4 if right_angle else 0.6)
    height = SIZE / 2 if name == "equirectangular" else SIZE
    axis.plot([0, SIZE, SIZE, 0, 0], [0, 0, height, height, 0], color="black", linewidth=0.9)
    axis.set_xlim(-MARGIN, SIZE + MARGIN)
    axis.set_ylim(height / 2 + SIZE / 2 + MARGIN, height / 2 - SIZE / 2 - MARGIN)
    axis.set_aspect("equal")
    axis.set_xticks([0, SIZE])
    axis.set_yticks([0, height])
    axis.set_title(f"{PANELS[name]}\nto {end:.0f}°", fontsize=8)


def draw_fold(axis, lines):
    inside, outside = lines["fold", "inside", 0], lines["fold", "outside", 0]
    axis.plot(*inside.T, color="#0072B2", label="domain")
    axis.plot(*outside.T, color="#D55E00", linestyle="--", label="beyond")
    axis.plot(*inside[-1], "o", color="#0072B2", markersize=4)
    level = 290
    axis.axhline(level, color="0.5", linewidth=0.7)
    for line in (inside, outside):
        crossing = np.flatnonzero(np.diff(np.sign(line[:, 1] - level)))
        axis.plot(line[crossing, 0], [level] * len(crossing), "k.", markersize=5)
    axis.set_xlim(0, 110)
    axis.set_ylim(0, 380)
    axis.set_xlabel("angle from the axis [°]", fontsize=8)
    axis.set_ylabel("radius [px]", fontsize=8)
    axis.legend(frameon=False, fontsize=7, loc="lower right")
    axis.set_title("Two angles, one pixel:\na fisheye that folds", fontsize=8)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("models")
    parser.add_argument("-o", "--output", default="docs/cameras.svg", help="svg or png")
    arguments = parser.parse_args()
    lines, ends = read(arguments.models)
    plt.rcParams.update({"font.size": 8})
    figure, axes = plt.subplots(2, 5, figsize=(10.5, 4.9), constrained_layout=True)
    for axis, name in zip(axes.flat, PANELS):
        draw_grid(axis, name, lines, ends[name])
    draw_fold(axes.flat[-1], lines)
    thin_svg.save(figure, arguments.output)


if __name__ == "__main__":
    main()

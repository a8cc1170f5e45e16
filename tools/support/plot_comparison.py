#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what the program compare_trajectories found: both paths, and the errors over time.

    compare_trajectories reference.tum estimate.tum --align se3 --errors errors.csv
    plot_comparison.py errors.csv errors.png     # .png or .svg; needs matplotlib
"""
import pathlib

import plotting
import standard_output
from plotting import Failure

ERRORS = ("#timestamp [ns],reference_x [m],reference_y [m],reference_z [m],estimate_x [m],estimate_y [m],estimate_z [m],"
          "translation_error [m],rotation_error [deg]")


def read(path):
    """The times in seconds from the first pair, and the other columns."""
    import numpy
    times, rows = [], []
    with open(path, encoding="utf-8", errors="replace") as file:
        for number, line in enumerate(file, 1):
            line = line.rstrip("\n")
            if number == 1:
                if line != ERRORS:
                    raise Failure(f"{path}:1: {line[:60]!r}, expected the header {ERRORS}")
                continue
            try:
                time, *fields = line.split(",")
                times.append(int(time))
                rows.append([float(field) for field in fields])
            except ValueError:
                raise Failure(f"{path}:{number}: {line[:60]!r}, expected numbers") from None
            if len(fields) != 8:
                raise Failure(f"{path}:{number}: {len(fields) + 1} columns, expected 9: {ERRORS[1:]}")
    if not rows:
        raise Failure(f"{path}: no rows, expected {ERRORS[1:]}")
    return numpy.array([time - times[0] for time in times], dtype=float) * 1e-9, numpy.array(rows)


def gaps(time):
    """The rows before which pairs are missing. Lines are broken there."""
    import numpy
    steps = numpy.diff(time)
    return numpy.flatnonzero(steps > 10 * numpy.median(steps)) + 1 if len(steps) else []


def draw_path(plot, rows, breaks, vertical):
    """Draws the reference, and the estimate coloured by its error, from above (vertical: 1) or from the side (2)."""
    import matplotlib.collections
    import numpy
    reference, estimate, error = rows[:, [0, vertical]], rows[:, [3, 3 + vertical]], rows[:, 6]
    plot.plot(*numpy.insert(reference, breaks, numpy.nan, axis=0).T, color="0.25", linewidth=1.0, zorder=2)
    segments = numpy.stack([estimate[:-1], estimate[1:]], axis=1)
    kept = numpy.setdiff1d(numpy.arange(len(segments)), numpy.asarray(breaks, dtype=int) - 1)
    lines = matplotlib.collections.LineCollection(segments[kept], cmap="viridis_r", linewidth=2.2, zorder=3, alpha=0.9)
    lines.set_array(((error[:-1] + error[1:]) / 2)[kept])
    lines.set_clim(0, max(float(error.max()), 1e-12))
    plot.add_collection(lines)
    plot.plot(*reference[0], "o", color="0.25", markersize=5, zorder=4)
    plot.set_aspect("equal", adjustable="datalim")
    plot.autoscale_view()
    plot.set_ylabel("yz"[vertical - 1] + " (m)")
    plot.grid(True, color="0.9", linewidth=0.7)
    plot.set_axisbelow(True)
    return lines


def draw_error(plot, time, values, breaks, name, unit):
    import numpy
    rms = float(numpy.sqrt(numpy.mean(values**2)))
    at, value = (numpy.insert(column, breaks, numpy.nan) for column in (time, values))
    plot.plot(at, value, color=plotting.BLUE, linewidth=0.9, zorder=3)
    plot.axhline(rms, color=plotting.RED, linewidth=1.0, linestyle=(0, (5, 3)), zorder=4, label=f"rmse {rms:.3g} {unit}")
    plot.set_ylim(0, max(1.15 * float(values.max()), 1e-12))
    plot.set_ylabel(f"{name} ({unit})")
    plot.legend(loc="lower right", bbox_to_anchor=(1, 1), frameon=False, fontsize=9, borderaxespad=0.2)
    plot.grid(True, color="0.9", linewidth=0.7)
    plot.set_axisbelow(True)


def draw(path, title):
    import matplotlib.figure
    import matplotlib.lines
    time, rows = read(path)
    breaks = gaps(time)
    figure = matplotlib.figure.Figure(figsize=(13, 6.5), dpi=110, layout="constrained")
    grid = figure.add_gridspec(2, 2, width_ratios=[1, 1.05], height_ratios=[2, 1])
    above, side = figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[1, 0])
    right = grid[:, 1].subgridspec(2, 1)
    translation = figure.add_subplot(right[0])
    rotation = figure.add_subplot(right[1], sharex=translation)

    lines = draw_path(above, rows, breaks, 1)
    draw_path(side, rows, breaks, 2)
    side.set_xlabel("x (m)")
    figure.colorbar(lines, ax=[above, side], location="right", pad=0.01, aspect=40, label="translation error (m)")
    entries = [matplotlib.lines.Line2D([], [], color="0.25", linewidth=1.0, marker="o", markersize=5, markevery=[0],
                                       label="reference, from its dot"),
               matplotlib.lines.Line2D([], [], color=lines.cmap(0.6), linewidth=2.2, label="estimate")]
    above.legend(handles=entries, loc="lower left", bbox_to_anchor=(0, 1), ncols=2, frameon=False, fontsize=9,
                 borderaxespad=0.2)

    draw_error(translation, time, rows[:, 6], breaks, "translation error", "m")
    draw_error(rotation, time, rows[:, 7], breaks, "rotation error", "deg")
    translation.tick_params(labelbottom=False)
    rotation.set_xlabel("time from the first pair (s)")
    if len(time) > 1:
        rotation.set_xlim(time[0], time[-1])
    figure.suptitle(title, x=0.01, ha="left", fontsize=12)
    return figure


def draw_to(picture, errors, title):
    if picture.exists() and picture.samefile(errors):
        raise Failure(f"{picture}: is read by this run and would be replaced by it, expected another name")
    plotting.save(draw(errors, title), picture)


def main():
    arguments = plotting.parser(__doc__)
    arguments.add_argument("errors", type=pathlib.Path, help="file written by compare_trajectories --errors")
    arguments.add_argument("picture", type=pathlib.Path, help="file to write: .png or .svg")
    arguments.add_argument("--title", default="", help="title of the picture")
    with standard_output.checked(plotting.script_name()):
        given = arguments.parse_args()
        if given.picture.suffix not in (".png", ".svg"):
            arguments.error(f"{given.picture}: expected a name that ends in .png or .svg")
        plotting.run(lambda: draw_to(given.picture, given.errors, given.title))


if __name__ == "__main__":
    main()

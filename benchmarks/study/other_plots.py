# SPDX-License-Identifier: MIT
"""Plots of error terms and of Allan deviations."""
import re

import matplotlib.pyplot as plt
import numpy as np

from plots import BLACK, BLUE, GREEN, ORANGE, PINK, RED, SKY, front, save
from results import log_text
from tables import number


def draw_error_terms(rows, folder):
    rows = [row for row in rows if row["model"] != "ErrorModel{}"]
    rows = sorted(rows, key=lambda row: row["extra_ns_median"])
    y = np.arange(len(rows))
    least = 0.03  # ns: below is what cannot be told from nothing
    middle = np.array([max(row["extra_ns_median"], least) for row in rows])
    low = np.array([max(row["extra_ns_min"], least) for row in rows])
    high = np.array([max(row["extra_ns_max"], least) for row in rows])
    figure, axis = plt.subplots(figsize=(9, 7.2), layout="constrained")
    colours = [BLUE if re.fullmatch(r"\w+", row["model"]) else ORANGE for row in rows]
    axis.barh(y, middle - least, left=least, color=colours, height=0.65, alpha=0.85)
    axis.errorbar(middle, y, xerr=[np.maximum(middle - low, 0), np.maximum(high - middle, 0)], fmt="none",
                  ecolor="0.25", elinewidth=0.9)
    for at, row in zip(y, rows):
        axis.annotate(number(row["extra_ns_median"]) if row["extra_ns_median"] > least else "0",
                      (max(row["extra_ns_max"], least), at), textcoords="offset points", xytext=(4, -3), fontsize=7.5)
    axis.set(xscale="log", xlim=(least, 3 * high.max()), ylim=(-0.7, len(rows) - 0.3),
             xlabel="ns a sample of both sensors, beyond the empty model: median, smallest and largest")
    axis.set_yticks(y, [row["model"] for row in rows])
    axis.grid(axis="y", visible=False)
    axis.legend(handles=[plt.Rectangle((0, 0), 1, 1, color=BLUE, label="one term"),
                         plt.Rectangle((0, 0), 1, 1, color=ORANGE, label="models that are used")], loc="lower right")
    save(figure, folder, "error_terms")


def draw_allan(rows, folder):
    """Error of N and of K against the time of an estimate."""
    rows = [row for row in rows if row["white_relative_error"] is not None]
    logs = sorted({row["samples"] for row in rows})
    figure, axes = plt.subplots(len(logs), 2, figsize=(9.5, 3.4 * len(logs)), layout="constrained", squeeze=False)
    names = list(dict.fromkeys(row["deviation"] for row in rows))
    grids = list(dict.fromkeys(row["grid"] for row in rows))
    colours = dict(zip(names, (BLUE, ORANGE, GREEN, RED, PINK, SKY, BLACK, "0.5")))
    markers = dict(zip(grids, "o^sDvP*X"))
    for line, samples in zip(axes, logs):
        for axis, column, name in zip(line, ("white_relative_error", "walk_relative_error"), ("N", "K")):
            some = [row for row in rows if row["samples"] == samples and row[column]]
            for row in some:
                axis.plot(row["ns_min"], row[column], markers[row["grid"]], color=colours[row["deviation"]],
                          markersize=6)
            best = front([(row["ns_min"], row[column]) for row in some])
            axis.plot([p[0] for p in best], [p[1] for p in best], color="0.5", linewidth=0.9, zorder=0)
            axis.set(xscale="log", ylim=(0, 1.08 * max((row[column] for row in some), default=1)),
                     title=f"{log_text(samples)}", xlabel="ns a sample", ylabel=f"relative error of {name}, RMS")
    handles = [plt.Line2D([], [], color=colour, linestyle="none", marker="o", label=name)
               for name, colour in colours.items()]
    handles += [plt.Line2D([], [], color="0.4", linestyle="none", marker=marker, label=f"averaging times: {grid}")
                for grid, marker in markers.items() if grid != "none"]
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    save(figure, folder, "allan")

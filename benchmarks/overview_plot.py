#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the README's picture of what `overview` has printed: overview_plot.py OVERVIEW.csv [-o docs/overview.svg]"""

import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import thin_svg

COLOURS = ("#D55E00", "#009E73", "#0072B2")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("overview")
    parser.add_argument("-o", "--output", default="docs/overview.svg", help="svg or png")
    arguments = parser.parse_args()
    data = np.genfromtxt(arguments.overview, delimiter=",", names=True)
    t = data["time_s"]

    plt.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False,
                         "figure.facecolor": "white"})
    figure = plt.figure(figsize=(10.5, 3.2), constrained_layout=True)
    path, signal, error = figure.subplots(1, 3, width_ratios=(0.9, 1.2, 1.1))

    path.plot(data["x_m"], data["y_m"], color="0.25")
    path.set_aspect("equal")
    path.set_xlabel("x [m]")
    path.set_ylabel("y [m]")
    path.set_title("A spline …", fontsize=10, loc="left")

    part = t <= 6
    for axis, colour in zip("xyz", COLOURS):
        signal.plot(t[part], data[f"gyro_{axis}"][part], color=colour, linewidth=0.5, alpha=0.6)
        signal.plot(t[part], data[f"ideal_gyro_{axis}"][part], color=colour, linewidth=1.2, label=axis)
    signal.set_xlabel("time [s]")
    signal.set_ylabel("angular rate [rad/s]")
    signal.set_title("… what a gyroscope measures along it …", fontsize=10, loc="left")
    signal.legend(frameon=False, ncols=3, loc="upper right", handlelength=1)

    looks = (("euler", "Euler", COLOURS[0]), ("noisy", "Midpoint, EuRoC's IMU", "0.45"),
             ("midpoint", "Midpoint", COLOURS[1]), ("magnus4", "Magnus4", COLOURS[2]))
    late = t > 0.1
    for name, label, colour in looks:
        error.semilogy(t[late], data[f"{name}_m"][late], color=colour, label=label)
    error.set_xlabel("time [s]")
    error.set_ylabel("position error [m]")
    error.set_title("… and what integration makes of it", fontsize=10, loc="left")
    for name, label, colour in looks:
        error.annotate(label, (t[-1], data[f"{name}_m"][-1]), xytext=(4, 0), textcoords="offset points",
                       color=colour, va="center", annotation_clip=False)
    thin_svg.save(figure, arguments.output)


if __name__ == "__main__":
    main()

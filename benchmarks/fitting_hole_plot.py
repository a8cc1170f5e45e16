#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what fitting_hole has printed: fitting_hole_plot.py HOLE.csv [-o docs/fitting_hole.svg]"""

import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import thin_svg


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("hole")
    parser.add_argument("-o", "--output", default="docs/fitting_hole.svg", help="svg or png")
    arguments = parser.parse_args()
    data = np.genfromtxt(arguments.hole, delimiter=",", names=True)
    data = data[(data["time_s"] > 1.1) & (data["time_s"] < 2.4)]
    t, measured = data["time_s"], ~np.isnan(data["pose_m"])
    times = t[measured]
    longest = np.argmax(np.diff(times))
    start, end = times[longest], times[longest + 1]

    plt.rcParams.update({"font.size": 9, "axes.spines.top": False, "axes.spines.right": False})
    figure, axes = plt.subplots(1, 3, figsize=(10.5, 3.3), constrained_layout=True)
    for axis in axes:
        axis.axvspan(start, end, color="0.92", label="hole")
        axis.set_xlim(1.1, 2.4)
        axis.set_xlabel("time [s]")
    looks = {"weak": ("poses alone", "#D55E00"), "held": ("with the prior", "#0072B2")}
    for axis, which in zip(axes[:2], (("weak", "held"), ("held",))):
        axis.plot(times, 1e3 * data["pose_m"][measured], ".", color="0.6", markersize=3, label="poses")
        for way in which:
            axis.plot(t, 1e3 * data[f"{way}_m"], color=looks[way][1], label=looks[way][0])
        axis.set_ylabel("x [mm]")
    axes[1].set_title("The same, 500 times larger", fontsize=9)
    axes[0].set_title("Position of a body at rest", fontsize=9)
    for way, (name, colour) in looks.items():
        axes[2].semilogy(t, data[f"{way}_force"], color=colour, label=name)
    axes[2].axhline(9.80665, color="0.4", linewidth=0.8, linestyle=":", label="at rest")
    axes[2].set_ylim(1.5, 4000)
    axes[2].set_ylabel("specific force [m/s²]")
    axes[2].set_title("What an accelerometer would read", fontsize=9)
    named = dict(zip(*reversed(axes[0].get_legend_handles_labels())))
    named.update(zip(*reversed(axes[2].get_legend_handles_labels())))
    figure.legend(named.values(), named.keys(), loc="outside upper center", ncols=len(named), frameon=False, fontsize=8)
    thin_svg.save(figure, arguments.output)


if __name__ == "__main__":
    main()

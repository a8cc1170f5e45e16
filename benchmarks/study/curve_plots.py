# SPDX-License-Identifier: MIT
"""Plots of curves: error against time, and against the knot interval."""
import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from plots import BLACK, BLUE, GREEN, ORANGE, PINK, STAR, front, panels, save
from results import GROUPS, ORDERS, SCENES, SHARE, choice_text, seconds_text


def pareto_legend(colours, looks):
    handles = [plt.Line2D([], [], color=colours[i], label=f"knots {seconds_text(i)} s apart") for i in colours]
    handles += [plt.Line2D([], [], color="0.3", linestyle="none", marker=marker, markersize=5,
                           markerfacecolor="0.3" if filled else "white", label=f"{GROUPS[group]}, {scalar}")
                for (group, scalar), (marker, filled) in looks.items()]
    handles += [plt.Line2D([], [], color=BLACK, linestyle=":", label="a tenth of the IMU's noise"),
                plt.Line2D([], [], marker="*", markersize=12, label="recommended", **STAR)]
    return handles


def draw_pareto(data, folder, column, label, noise):
    """Error against ns a sample of sample_imu(): a colour for each knot interval, a front for each."""
    intervals = [i for i in (0.1, 0.05, 0.025, 0.0125) if i in data.intervals]
    colours = dict(zip(intervals, (PINK, ORANGE, BLUE, GREEN)))
    looks = {("SO3xR3", "double"): ("o", True), ("SO3xR3", "float"): ("^", True),
             ("SE3", "double"): ("s", False), ("SE3", "float"): ("v", False)}
    figure, axes = panels(len(data.scenes), 3.9)
    for axis, scene in zip(axes, data.scenes):
        for interval in intervals:
            points = []
            for (group, scalar), (marker, filled) in looks.items():
                for order in ORDERS:
                    row = data.one(scene=scene, group=group, scalar=scalar, order=order, knot_interval=interval)
                    x = data.time("dense", interval, group=group, scalar=scalar, order=order)
                    points.append((x, row[column]))
                    axis.plot(x, row[column], marker, color=colours[interval], markersize=4, linestyle="none",
                              markerfacecolor=colours[interval] if filled else "white", zorder=3)
                    if interval == intervals[-1] and (group, scalar) == ("SO3xR3", "double"):
                        axis.annotate(f"{order}", (x, row[column]), textcoords="offset points", xytext=(7, 4),
                                      fontsize=8)
            best = front(points)
            axis.plot([p[0] for p in best], [p[1] for p in best], color=colours[interval], zorder=2)
        axis.axhline(SHARE * noise, color=BLACK, linestyle=":", linewidth=1)
        axis.set(xscale="log", yscale="log", title=SCENES[scene])
        pick = data.recommended(scene)
        if pick:
            x = data.time("dense", pick["knot_interval"], group=pick["group"], scalar="double", order=pick["order"])
            axis.plot(x, pick[column], "*", markersize=15, zorder=4, **STAR)
            axis.set_title(f"{SCENES[scene]}\n★ {choice_text(pick)}", fontsize=9)
    for axis in axes:
        axis.xaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
        axis.xaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda x, _: f"{x:g}"))
        axis.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
        axis.set_xlabel("ns a sample of sample_imu()")
    for axis in axes[::2]:
        axis.set_ylabel(label)
    handles = pareto_legend(colours, looks)
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    save(figure, folder, f"representation_pareto_{column.split('_')[0]}")


def draw_knots(data, folder, column, label, noise, derivative):
    """Error against knot interval, a colour for each order. Theory has it fall with the power order − derivative."""
    figure, axes = panels(len(data.scenes), 3.7)
    colours = dict(zip(ORDERS, plt.get_cmap("viridis")(np.linspace(0, 0.92, len(ORDERS)))))
    for axis, scene in zip(axes, data.scenes):
        for order in ORDERS:
            for scalar, line in (("float", ":"), ("double", "-")):
                rows = sorted(data.find(scene=scene, group="SO3xR3", scalar=scalar, order=order),
                              key=lambda row: row["knot_interval"])
                axis.plot([row["knot_interval"] for row in rows], [row[column] for row in rows], line,
                          color=colours[order], marker="o" if scalar == "double" else None, markersize=3)
        axis.axhline(SHARE * noise, color=BLACK, linestyle="--", linewidth=0.8)
        pick = data.recommended(scene)
        if pick:
            axis.plot(pick["knot_interval"], pick[column], "*", markersize=14, zorder=4, **STAR)
        title = SCENES[scene] + (f"\n★ {choice_text(pick)}" if pick else "")
        axis.set(xscale="log", yscale="log", xlabel="knot interval [s]")
        axis.set_title(title, fontsize=9)
        axis.set_xticks(data.intervals, [seconds_text(i) for i in data.intervals], fontsize=7.5)
        axis.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
    for axis in axes[::2]:
        axis.set_ylabel(label)
    handles = [plt.Line2D([], [], color=colours[order], marker="o", markersize=3,
                          label=f"order {order}: ~ interval{' ²³⁴⁵⁶⁷'[order - derivative - 1].strip()}")
               for order in ORDERS]
    handles += [plt.Line2D([], [], color="0.3", linestyle=":", label="the same in float"),
                plt.Line2D([], [], color=BLACK, linestyle="--", linewidth=0.8, label="a tenth of the IMU's noise")]
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    save(figure, folder, f"representation_knots_{column.split('_')[0]}")

# SPDX-License-Identifier: MIT
"""Plots of integrators: error against time, and against the rate."""
import matplotlib
import matplotlib.pyplot as plt

from plots import BLACK, BLUE, GREEN, ORANGE, PINK, RED, SKY, front, panels, save
from results import GRADES, INCREMENT_SCHEMES, POINT_SCHEMES, RATE, SCENES, SHARE

POINT_COLOURS = dict(zip(POINT_SCHEMES, (PINK, ORANGE, GREEN, SKY, BLUE, "0.55", RED)))
INCREMENT_COLOURS = dict(zip(INCREMENT_SCHEMES, (PINK, ORANGE, BLUE, RED)))
COLOURS = {**POINT_COLOURS, **INCREMENT_COLOURS}
LINES = dict(zip(GRADES, ((0, (1, 1)), (0, (4, 1.5, 1, 1.5)), (0, (5, 2)))))


def grade_labels(data, scene, rate):
    """Names of grades and where to write them: those that would be written upon one another together."""
    groups = []
    for grade in sorted(GRADES, key=lambda grade: data.floor(scene, grade, rate)):
        floor = data.floor(scene, grade, rate)
        if groups and floor < 1.7 * groups[-1][1]:
            groups[-1] = (f"{groups[-1][0]}, {grade}", floor)
        else:
            groups.append((grade, floor))
    return groups


def draw_integrators_pareto(data, folder):
    rate = RATE if RATE in data.rates else data.rates[-1]
    figure, axes = panels(len(data.scenes), 4.2)
    for axis, scene in zip(axes, data.scenes):
        points = []
        for scheme in data.schemes:
            colour = COLOURS[scheme]
            x, y = data.times(scheme)[0], data.error[scene, "none", rate, scheme]
            points.append((x, y, scheme))
            axis.plot(x, y, "o" if scheme in POINT_SCHEMES else "D", color=colour, markersize=6, zorder=3)
        for schemes, line in ((POINT_SCHEMES, "-"), (INCREMENT_SCHEMES, "--")):
            best = front([p for p in points if p[2] in schemes])
            axis.plot([p[0] for p in best], [p[1] for p in best], line, color="0.4", zorder=2)
        for names, floor in grade_labels(data, scene, rate):
            axis.annotate(names, (1, SHARE * floor), xycoords=("axes fraction", "data"), textcoords="offset points",
                          xytext=(-3, 2), ha="right", fontsize=7.5)
        for grade in GRADES:
            axis.axhline(SHARE * data.floor(scene, grade, rate), color=BLACK, linestyle=":", linewidth=0.9)
        pick = data.cheapest(scene, "industrial", rate, POINT_SCHEMES)
        axis.set(xscale="log", yscale="log", xlabel="ns a sample")
        axis.set_title(SCENES[scene] + (f"\n★ {pick}" if pick else ""), fontsize=9)
        if pick:
            axis.plot(data.times(pick)[0], data.error[scene, "none", rate, pick], "*", markersize=17, color="none",
                      markeredgecolor=BLACK, zorder=4)
        axis.xaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
        axis.xaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda x, _: f"{x:g}"))
        axis.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    axes[0].set_ylabel(f"position error over 10 s at {rate:g} Hz, RMS [m]")
    handles = [plt.Line2D([], [], color=colour, linestyle="none", marker=marker, label=scheme)
               for schemes, marker in ((POINT_COLOURS, "o"), (INCREMENT_COLOURS, "D"))
               for scheme, colour in schemes.items() if scheme in data.schemes]
    handles += [plt.Line2D([], [], color="0.4", label="front, point samples"),
                plt.Line2D([], [], color="0.4", linestyle="--", label="front, increments"),
                plt.Line2D([], [], color=BLACK, linestyle=":", label="a tenth of the noise's error")]
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    save(figure, folder, "integrators_pareto")


def draw_integrators_rates(data, folder):
    figure, axes = panels(len(data.scenes), 4.4)
    for axis, scene in zip(axes, data.scenes):
        for scheme in data.schemes:
            colour = COLOURS[scheme]
            axis.plot(data.rates, [data.error[scene, "none", rate, scheme] for rate in data.rates],
                      "-o" if scheme in POINT_SCHEMES else "--D", color=colour, markersize=3)
        for grade, line in LINES.items():
            axis.plot(data.rates, [data.floor(scene, grade, rate) for rate in data.rates], color=BLACK, linestyle=line,
                      linewidth=1.3, zorder=4)
        pick = data.cheapest(scene, "industrial", RATE if RATE in data.rates else data.rates[-1], POINT_SCHEMES)
        axis.set(xscale="log", yscale="log", xlabel="rate [Hz]")
        axis.set_title(SCENES[scene] + (f"\n★ {pick}" if pick else ""), fontsize=9)
        axis.set_xticks(data.rates, [f"{rate:g}" for rate in data.rates], fontsize=7.5)
        axis.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
    axes[0].set_ylabel("position error over 10 s, RMS [m]")
    handles = [plt.Line2D([], [], color=colour, linestyle=line, marker=marker, markersize=4, label=scheme)
               for schemes, line, marker in ((POINT_COLOURS, "-", "o"), (INCREMENT_COLOURS, "--", "D"))
               for scheme, colour in schemes.items() if scheme in data.schemes]
    handles += [plt.Line2D([], [], color=BLACK, linestyle=line, linewidth=1.3, label=f"noise alone, {grade}")
                for grade, line in LINES.items()]
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    save(figure, folder, "integrators_rates")

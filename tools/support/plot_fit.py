#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what the program fit_trajectory computed: FOLDER/fit.png and FOLDER/fit.svg.

    fit_trajectory poses.tum --imu imu.csv --output FOLDER
    plot_fit.py FOLDER               # reads its files; needs matplotlib
"""
import plotting
from plot_fit_files import (DERIVED, RESIDUALS, gaps_between_poses, knot_interval, read, read_gaps, read_imu, read_samples,
                            seconds, title_of)
from plotting import Failure

COLOURS = [plotting.BLUE, plotting.ORANGE, plotting.GREEN]  # of the axes
OUTLIER = plotting.RED
MOST_POINTS = 1600  # of a line, enough for its pixels


def thinned(time, values):
    """Keeps the minimum and the maximum of each block of samples, so that the line looks the same."""
    import numpy
    stretch = -(-2 * len(time) // MOST_POINTS)
    if stretch <= 2:
        return time, values
    count = len(time) // stretch
    blocks = values[:count * stretch].reshape(count, stretch)
    first = numpy.minimum(blocks.argmin(axis=1), blocks.argmax(axis=1))
    last = numpy.maximum(blocks.argmin(axis=1), blocks.argmax(axis=1))
    places = (numpy.stack([first, last], axis=1) + numpy.arange(count)[:, None] * stretch).ravel()
    places = numpy.unique(numpy.append(places, len(time) - 1))
    return time[places], values[places]


def broken(time, values, gaps):
    """Adds a break in each gap that has no values, so that no line is drawn across it."""
    import numpy
    middles = numpy.array([(begin + end) / 2 for begin, end in gaps
                           if not ((time > begin + 1e-6) & (time < end - 1e-6)).any()])
    places = numpy.searchsorted(time, middles)
    return numpy.insert(time, places, middles), numpy.insert(values, places, numpy.nan)


def smooth(values, width):
    """Low-passes the columns with a Hann window of `width` samples, without delay. It is shorter at the ends."""
    import numpy
    width = max(1, min(int(width) | 1, len(values) - 1 | 1))
    window = numpy.hanning(width + 2)[1:-1]
    weight = numpy.convolve(numpy.ones(len(values)), window, "same")
    return numpy.stack([numpy.convolve(column, window, "same") / weight for column in values.T], axis=1)


def usual_size(values, share):
    """The magnitude below which the fraction `share` of the values is; never 0."""
    import numpy
    size = numpy.abs(values)
    usual = float(numpy.quantile(size, share)) if size.size else 0
    return usual or max(1e-12, float(size.max(initial=0)))


def set_logarithmic_scale(plot, limit, largest):
    """Scales values logarithmically beyond `limit`, which is rounded up. Returns the limit used."""
    import numpy
    # The limit is a round number, because it gets a tick label.
    power = 10 ** numpy.floor(numpy.log10(limit))
    limit = float(power * next(round_number for round_number in (1, 2, 5, 10) if round_number * power >= limit))
    plot.set_yscale("symlog", linthresh=limit, linscale=1.6)
    top = largest * 1.5
    decades = [limit * 10**i for i in range(1, 8) if limit * 10**i < top]
    ticks = [0, limit / 2, limit] + decades[::-(-len(decades) // 3) or 1]
    plot.set_yticks([-tick for tick in ticks[:0:-1]] + ticks)
    plot.set_ylim(-top, top)
    plot.yaxis.set_major_formatter(lambda value, _: f"{value:g}")
    plot.minorticks_off()
    for border in (-limit, limit):
        plot.axhline(border, color="0.55", linewidth=0.7, linestyle=(0, (4, 3)), zorder=2)
    plot.annotate("logarithmic beyond the dashed lines", (1, 1), xycoords="axes fraction", xytext=(-4, -4),
                  textcoords="offset points", ha="right", va="top", fontsize=8, color="0.4")
    return limit


def draw_distribution(side, values, limit):
    import numpy
    edges = numpy.linspace(-limit, limit, 61)
    middle = (edges[1:] + edges[:-1]) / 2
    for i, colour in enumerate(COLOURS):
        counts, _ = numpy.histogram(values[:, i], edges, density=True)
        side.step(counts, middle, where="mid", color=colour, linewidth=0.9)
    side.set_ylim(-limit, limit)
    side.set_xticks([])
    side.yaxis.tick_right()
    side.tick_params(labelsize=8)


def draw_residuals(plot, side, time, values, outliers, gaps, unit, share=0.995):
    """Draws one row: residuals over time, and their distribution. With far outliers the scale is logarithmic beyond a
    limit."""
    import numpy
    inner = values[~outliers] if (~outliers).any() else values
    usual, largest = usual_size(inner, share), float(numpy.abs(values).max(initial=0))
    limit = 1.6 * usual
    for i, colour in enumerate(COLOURS):
        plot.plot(*broken(*thinned(time, values[:, i]), gaps), color=colour, linewidth=0.7, zorder=3, alpha=0.9)
    places = numpy.flatnonzero(outliers & (numpy.abs(values).max(axis=1) > usual))  # of this row, not the other
    worst = values[places, numpy.abs(values[places]).argmax(axis=1)] if places.size else numpy.empty(0)
    plot.plot(time[places], worst, ".", color=OUTLIER, markersize=3.5, zorder=4, markeredgewidth=0)
    if largest > 3 * limit:
        limit = set_logarithmic_scale(plot, limit, largest)
    else:
        top = max(limit, largest * 1.1)
        plot.set_ylim(-top, top)
    text = ",  ".join(f"{axis} {numpy.sqrt(numpy.mean(inner[:, i]**2)):.2g}" for i, axis in enumerate("xyz"))
    plot.annotate(f"rms {text} {unit}" + (", without outliers" if outliers.any() else ""), (0, 1), xycoords="axes fraction",
                  xytext=(4, -4), textcoords="offset points", va="top", fontsize=8.5, zorder=6,
                  bbox={"boxstyle": "round,pad=0.2", "facecolor": "white", "alpha": 0.85, "linewidth": 0})
    draw_distribution(side, inner, limit)


def draw_signal(plot, time, values, gaps, behind=None):
    import numpy
    if behind is not None:
        for i, colour in enumerate(COLOURS):
            plot.plot(*broken(*thinned(behind[0], behind[1][:, i]), gaps), color=colour, linewidth=2.4, alpha=0.35, zorder=2)
    for i, colour in enumerate(COLOURS):
        plot.plot(*broken(*thinned(time, values[:, i]), gaps), color=colour, linewidth=0.8, zorder=3)
    low, high = numpy.quantile(values, 0.0005), numpy.quantile(values, 0.9995)
    margin = 0.15 * (high - low) or 1
    low, high = low - margin, high + margin
    plot.set_ylim(low, high)
    beyond = (values < low) | (values > high)
    if beyond.any():
        plot.annotate(f"beyond the frame in {beyond.any(axis=1).sum()} readings, up to {numpy.abs(values).max():.3g}",
                      (1, 1), xycoords="axes fraction", xytext=(-4, -4), textcoords="offset points", ha="right", va="top",
                      fontsize=8, color="0.4", zorder=6,
                      bbox={"boxstyle": "round,pad=0.2", "facecolor": "white", "alpha": 0.85, "linewidth": 0})


def grid_of_plots(figure, count):
    """The plots of all rows, and those of distributions beside them: rows 2 and 3 have none."""
    grid = figure.add_gridspec(count, 2, width_ratios=[9, 1], wspace=0.01, hspace=0.03)
    plots = [figure.add_subplot(grid[0, 0])]
    for row in range(1, count):
        plots.append(figure.add_subplot(grid[row, 0], sharex=plots[0]))
    sides = {row: figure.add_subplot(grid[row, 1]) for row in range(count) if row not in (2, 3)}
    return grid, plots, sides


def draw_imu(plots, sides, imu, gaps, interval):
    """Draws rows 2 to 5: the curve and the samples of the IMU, and their differences. Returns the text on the
    low-pass, which cuts off where the curve does, at half a period per knot interval."""
    import numpy
    time, values = imu
    rate = 1 / float(numpy.median(numpy.diff(time)))
    width = max(3, 4 * interval * rate)
    curve, residual = values[:, :6], values[:, 6:12]
    low = smooth(curve - residual, width)
    left = smooth(residual, width)
    draw_signal(plots[2], time, curve[:, :3], gaps, (time, low[:, :3]))
    draw_signal(plots[3], time, curve[:, 3:6], gaps, (time, low[:, 3:6]))
    quiet = numpy.zeros(len(time), dtype=bool)
    draw_residuals(plots[4], sides[4], time, left[:, :3], quiet, [], "rad/s", 0.98)
    draw_residuals(plots[5], sides[5], time, left[:, 3:6], quiet, [], "m/s²", 0.98)
    return f"low-passed\n(Hann, {width / rate:.2g} s);\nso are the two\nlowest rows"


def label(plots, time, outliers, gaps):
    import numpy
    names = ["position\ncurve − pose (mm)", "rotation\ncurve − pose (mrad)", "angular velocity\n(rad/s)",
             "specific force\n(m/s²)", "gyroscope\ncurve − IMU (rad/s)", "accelerometer\ncurve − IMU (m/s²)"]
    for plot, name in zip(plots, names):
        plot.set_ylabel(name)
        plot.grid(True, color="0.9", linewidth=0.7)
        plot.set_axisbelow(True)
        for begin, end in gaps:
            plot.axvspan(begin, end, facecolor="0.8", edgecolor="0.6", linewidth=0.8, zorder=1)
        plot.tick_params(labelbottom=plot is plots[-1])
    span = time[-1] - time[0]
    plots[0].set_xlim(-0.01 * span, 1.01 * span)
    plots[-1].set_xlabel("time from the first pose (s)")
    for plot in plots[:2]:  # marks of outliers at the lower edge
        plot.plot(time[outliers], numpy.full(outliers.sum(), 0.015), "|", color=OUTLIER, markersize=5,
                  transform=plot.get_xaxis_transform(), zorder=5)


def draw_legend(plot, low_pass, outliers, gaps):
    """`low_pass` is the text on the samples of the IMU; nothing if there is none."""
    import matplotlib.lines
    import matplotlib.patches

    def line(**style):
        return matplotlib.lines.Line2D([], [], **style)

    entries = [line(color=colour, linewidth=1.8, label=axis) for axis, colour in zip("xyz", COLOURS)]
    if low_pass:
        entries.append(line(color="0.4", linewidth=0.9, label="the curve,\nwith biases"))
        entries.append(line(color="0.4", linewidth=2.6, alpha=0.4, label=f"the IMU,\n{low_pass}"))
    if outliers.any():
        entries.append(line(color=OUTLIER, linestyle="none", marker="|", markeredgewidth=1.5,
                            label=f"outliers\n({outliers.sum()} poses)"))
    if gaps:
        entries.append(matplotlib.patches.Patch(facecolor="0.8", edgecolor="0.6", label="gaps between\nposes"))
    plot.axis("off")
    plot.legend(handles=entries, loc="center left", frameon=False, fontsize=9, borderaxespad=0, handlelength=1.4,
                labelspacing=0.8)


def draw(folder):
    import matplotlib.figure
    import numpy

    times, rows = read(folder / "residuals.csv", RESIDUALS)
    if not rows:
        raise Failure(f"{folder / 'residuals.csv'}: no rows, expected {RESIDUALS[1:]}")
    start, rows = times[0], numpy.array(rows)
    time, outliers = seconds(times, start), rows[:, 6] != 0
    gaps = read_gaps(folder, start)
    imu = read_imu(folder, start)
    derived = read_samples(folder / "derived_imu.csv", DERIVED, start) if imu is None else None
    interval = knot_interval(folder)
    gaps += gaps_between_poses(time, gaps, interval)

    count = 4 if imu is None else 6
    figure = matplotlib.figure.Figure(figsize=(13, 2.0 * count + 0.9), dpi=110, layout="constrained")
    grid, plots, sides = grid_of_plots(figure, count)
    draw_residuals(plots[0], sides[0], time, rows[:, 3:6] * 1e3, outliers, gaps, "mm")
    draw_residuals(plots[1], sides[1], time, rows[:, :3] * 1e3, outliers, gaps, "mrad")
    if imu is None:
        draw_signal(plots[2], derived[0], derived[1][:, :3], gaps)
        draw_signal(plots[3], derived[0], derived[1][:, 3:6], gaps)
        low_pass = ""
    else:
        low_pass = draw_imu(plots, sides, imu, gaps, interval)
    label(plots, time, outliers, gaps)
    figure.suptitle(title_of(folder), x=0.01, ha="left", fontsize=12)
    draw_legend(figure.add_subplot(grid[2:4, 1]), low_pass, outliers, gaps)
    figure.align_ylabels(plots)
    return figure


if __name__ == "__main__":
    plotting.run_on_folder(__doc__, "output folder of fit_trajectory, also for the pictures", "fit", draw)

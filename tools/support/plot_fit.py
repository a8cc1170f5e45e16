#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what the program fit_trajectory computed: FOLDER/fit.png and FOLDER/fit.svg.

    fit_trajectory poses.tum --imu imu.csv --output FOLDER
    plot_fit.py FOLDER               # reads its files; needs matplotlib
"""
import os
import re

import plotting
from plotting import Failure

RESIDUALS = ("#timestamp [ns],rotation_x [rad],rotation_y [rad],rotation_z [rad],position_x [m],position_y [m],"
             "position_z [m],outlier")
GAPS = "#start [ns],end [ns],length [s]"
DERIVED = ("#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],a_RS_S_x [m s^-2],"
           "a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]")
SAMPLES = ("#timestamp [ns],gyro_x [rad/s],gyro_y [rad/s],gyro_z [rad/s],accel_x [m/s^2],accel_y [m/s^2],"
           "accel_z [m/s^2],gyro_residual_x [rad/s],gyro_residual_y [rad/s],gyro_residual_z [rad/s],"
           "accel_residual_x [m/s^2],accel_residual_y [m/s^2],accel_residual_z [m/s^2],invented")
COLOURS = [plotting.BLUE, plotting.ORANGE, plotting.GREEN]  # of the axes
OUTLIER = plotting.RED
MOST_POINTS = 1600  # of a line, enough for its pixels


def read(path, header):
    """The times [ns], as integers, and the rows, as numbers."""
    times, rows, number = [], [], 0
    with open(path, encoding="utf-8", errors="replace") as file:
        for number, line in enumerate(file, 1):
            line = line.rstrip("\n")
            if number == 1:
                if line != header:
                    raise Failure(f"{path}:1: {line[:60]!r}, expected the header {header}")
                continue
            if line.startswith("#"):
                continue
            fields = line.split(",")
            if len(fields) != header.count(",") + 1:
                raise Failure(f"{path}:{number}: {len(fields)} columns, expected {header.count(',') + 1}: {header[1:]}")
            try:
                times.append(int(fields[0]))
                rows.append([float(field) for field in fields[1:]])
            except ValueError:
                raise Failure(f"{path}:{number}: {line[:60]!r}, expected numbers") from None
    if number == 0:
        raise Failure(f"{path}: empty, expected the header {header}")
    return times, rows


def seconds(times, start):
    import numpy
    return numpy.array([time - start for time in times], dtype=float) * 1e-9


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


def knot_interval(folder):
    """The interval of uniform knots, s; the median length of the segments of others."""
    import numpy
    header = (folder / "control_points.csv").read_text(encoding="utf-8", errors="replace")[:2000]
    found = re.search(r"^# interval \[ns\]: (\d+)$", header, re.MULTILINE)
    if found:
        return int(found[1]) * 1e-9
    knots, _ = read(folder / "knots.csv", "#knot [ns]")
    lengths = numpy.diff(numpy.array([knot - knots[0] for knot in knots], dtype=float)) * 1e-9
    return float(numpy.median(lengths[lengths > 0])) if (lengths > 0).any() else 0.05


def title_of(folder):
    """A title from the lines of report.txt on poses, spline and knots."""
    try:
        lines = (folder / "report.txt").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return ""
    place = next((i for i, line in enumerate(lines) if line.startswith("spline: ")), 0)
    if not 0 < place < len(lines) - 1:
        return ""
    name = os.path.basename(lines[place - 1].split(": ")[0])
    spline = lines[place].removeprefix("spline: ").replace("R^3", "R³").replace(" x ", " × ")
    return f"{name}:  spline of {spline}, {re.split(', the | [(]', lines[place + 1])[0]}"


def usual_size(values, share):
    """The magnitude below which the fraction `share` of the values is; never 0."""
    import numpy
    size = numpy.abs(values)
    usual = float(numpy.quantile(size, share)) if size.size else 0
    return usual or max(1e-12, float(size.max(initial=0)))


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
    else:
        top = max(limit, largest * 1.1)
        plot.set_ylim(-top, top)
    text = ",  ".join(f"{axis} {numpy.sqrt(numpy.mean(inner[:, i]**2)):.2g}" for i, axis in enumerate("xyz"))
    plot.annotate(f"rms {text} {unit}" + (", without outliers" if outliers.any() else ""), (0, 1), xycoords="axes fraction",
                  xytext=(4, -4), textcoords="offset points", va="top", fontsize=8.5, zorder=6,
                  bbox={"boxstyle": "round,pad=0.2", "facecolor": "white", "alpha": 0.85, "linewidth": 0})

    edges = numpy.linspace(-limit, limit, 61)
    middle = (edges[1:] + edges[:-1]) / 2
    for i, colour in enumerate(COLOURS):
        counts, _ = numpy.histogram(inner[:, i], edges, density=True)
        side.step(counts, middle, where="mid", color=colour, linewidth=0.9)
    side.set_ylim(-limit, limit)
    side.set_xticks([])
    side.yaxis.tick_right()
    side.tick_params(labelsize=8)


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


def draw(folder):
    import matplotlib.figure
    import matplotlib.lines
    import matplotlib.patches
    import numpy

    times, rows = read(folder / "residuals.csv", RESIDUALS)
    if not rows:
        raise Failure(f"{folder / 'residuals.csv'}: no rows, expected {RESIDUALS[1:]}")
    start, rows = times[0], numpy.array(rows)
    time, outliers = seconds(times, start), rows[:, 6] != 0
    gap_starts, gap_rows = read(folder / "gaps.csv", GAPS)
    gaps = list(zip(seconds(gap_starts, start), seconds([int(row[0]) for row in gap_rows], start)))
    imu_path = folder / "imu_residuals.csv"
    imu = None
    if imu_path.exists():
        imu_times, imu_rows = read(imu_path, SAMPLES)
        if len(imu_rows) > 1:
            imu = seconds(imu_times, start), numpy.array(imu_rows)
    if imu is None:
        derived_times, derived = read(folder / "derived_imu.csv", DERIVED)
        derived_time, derived = seconds(derived_times, start), numpy.array(derived)

    # Gaps between poses of more than two knot intervals, whether or not neighbouring poses determine the curve there.
    interval = knot_interval(folder)
    sparse = numpy.flatnonzero(numpy.diff(time) > 2 * interval)
    gaps += [(time[i], time[i + 1]) for i in sparse
             if not any(begin < time[i + 1] and end > time[i] for begin, end in gaps)]

    count = 4 if imu is None else 6
    figure = matplotlib.figure.Figure(figsize=(13, 2.0 * count + 0.9), dpi=110, layout="constrained")
    grid = figure.add_gridspec(count, 2, width_ratios=[9, 1], wspace=0.01, hspace=0.03)
    plots = [figure.add_subplot(grid[0, 0])]
    for row in range(1, count):
        plots.append(figure.add_subplot(grid[row, 0], sharex=plots[0]))
    sides = {row: figure.add_subplot(grid[row, 1]) for row in range(count) if row not in (2, 3)}

    draw_residuals(plots[0], sides[0], time, rows[:, 3:6] * 1e3, outliers, gaps, "mm")
    draw_residuals(plots[1], sides[1], time, rows[:, :3] * 1e3, outliers, gaps, "mrad")
    names = ["position\ncurve − pose (mm)", "rotation\ncurve − pose (mrad)", "angular velocity\n(rad/s)",
             "specific force\n(m/s²)", "gyroscope\ncurve − IMU (rad/s)", "accelerometer\ncurve − IMU (m/s²)"]
    if imu is None:
        draw_signal(plots[2], derived_time, derived[:, :3], gaps)
        draw_signal(plots[3], derived_time, derived[:, 3:6], gaps)
        low_pass = ""
    else:
        imu_time, values = imu
        # The low-pass cuts off where the curve does, at half a period per knot interval.
        rate = 1 / float(numpy.median(numpy.diff(imu_time)))
        width = max(3, 4 * interval * rate)
        curve, residual = values[:, :6], values[:, 6:12]
        low = smooth(curve - residual, width)
        left = smooth(residual, width)
        draw_signal(plots[2], imu_time, curve[:, :3], gaps, (imu_time, low[:, :3]))
        draw_signal(plots[3], imu_time, curve[:, 3:6], gaps, (imu_time, low[:, 3:6]))
        quiet = numpy.zeros(len(imu_time), dtype=bool)
        draw_residuals(plots[4], sides[4], imu_time, left[:, :3], quiet, [], "rad/s", 0.98)
        draw_residuals(plots[5], sides[5], imu_time, left[:, 3:6], quiet, [], "m/s²", 0.98)
        low_pass = f"low-passed\n(Hann, {width / rate:.2g} s);\nso are the two\nlowest rows"

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
    figure.suptitle(title_of(folder), x=0.01, ha="left", fontsize=12)

    def line(**style):
        return matplotlib.lines.Line2D([], [], **style)

    entries = [line(color=colour, linewidth=1.8, label=axis) for axis, colour in zip("xyz", COLOURS)]
    if imu is not None:
        entries.append(line(color="0.4", linewidth=0.9, label="the curve,\nwith biases"))
        entries.append(line(color="0.4", linewidth=2.6, alpha=0.4, label=f"the IMU,\n{low_pass}"))
    if outliers.any():
        entries.append(line(color=OUTLIER, linestyle="none", marker="|", markeredgewidth=1.5,
                            label=f"outliers\n({outliers.sum()} poses)"))
    if gaps:
        entries.append(matplotlib.patches.Patch(facecolor="0.8", edgecolor="0.6", label="gaps between\nposes"))
    legend = figure.add_subplot(grid[2:4, 1])
    legend.axis("off")
    legend.legend(handles=entries, loc="center left", frameon=False, fontsize=9, borderaxespad=0, handlelength=1.4,
                  labelspacing=0.8)
    figure.align_ylabels(plots)
    return figure


if __name__ == "__main__":
    plotting.run_on_folder(__doc__, "output folder of fit_trajectory, also for the pictures", "fit", draw)

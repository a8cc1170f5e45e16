#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the Allan deviation that the example program allan computed: FOLDER/allan.png and FOLDER/allan.svg.

    allan imu.csv --output FOLDER
    plot_allan.py FOLDER             # reads FOLDER/curves.csv and FOLDER/noise.csv; needs matplotlib
"""
import csv
import math

import plotting
from plotting import Failure

CURVES = "#sensor,axis,m,tau [s],terms,deviation,lower,upper,alpha,fitted"
NOISE = "#sensor,axis,term,detected,estimate,lower,upper,standard_error,unit"

# The Allan deviation that a coefficient of 1 gives at 1 s, and its slope; so it can be read off the line at the time
# where the line has the coefficient's value.
LINES = {
    "Q": (math.sqrt(3), -1),
    "N": (1, -0.5),
    "B": (math.sqrt(2 * math.log(2) / math.pi), 0),
    "K": (1 / math.sqrt(3), 0.5),
    "R": (1 / math.sqrt(2), 1),
}
SIDES = {  # of the point on the line where its text may stand, the best first
    "Q": ["lower left", "upper right", "upper left", "lower right"],
    "N": ["upper right", "lower left", "upper left", "lower right"],
    "B": ["upper right", "lower right"],
    "K": ["lower right", "upper left", "lower left", "upper right"],
    "R": ["lower right", "upper left", "lower left", "upper right"],
}
DEGREE, MICRO_G = math.pi / 180, 9.80665e-6
FLOOR = math.sqrt(2 * math.log(2) / math.pi)  # of the curve over B, which data sheets call bias instability
FAMILIAR = {  # what data sheets write
    ("gyroscope", "N"): (DEGREE / 60, "°/√h"),
    ("gyroscope", "B"): (DEGREE / 3600 / FLOOR, "°/h, floor"),
    ("accelerometer", "N"): (1 / 60, "m/s/√h"),
    ("accelerometer", "B"): (MICRO_G / FLOOR, "µg, floor"),
}
UNITS = {"gyroscope": "rad/s", "accelerometer": "m/s²"}
GUIDE, DOTTED = "0.45", (0, (1, 1.5))
COLOURS = [plotting.BLUE, plotting.RED, plotting.GREEN, plotting.PURPLE, plotting.ORANGE, plotting.SKY]


def read(path, header):
    """The rows as dictionaries; what is not in the file is an empty text."""
    names = [name.split(" ")[0] for name in header[1:].split(",")]
    rows = []
    with open(path, newline="", encoding="utf-8", errors="replace") as file:
        for number, row in enumerate(csv.reader(file), 1):
            if number == 1:
                if ",".join(row) != header:
                    raise Failure(f"{path}:1: {','.join(row)[:60]!r}, expected the header {header}")
                continue
            if len(row) != len(names):
                raise Failure(f"{path}:{number}: {len(row)} columns, expected {len(names)}: {header[1:]}")
            rows.append(dict(zip(names, row), place=f"{path}:{number}"))
    if not rows:
        raise Failure(f"{path}: no rows, expected {header[1:]}")
    return rows


def number(row, name):
    try:
        return float(row[name])
    except ValueError:
        raise Failure(f"{row['place']}: {row[name]!r}, expected a number for {name}") from None


def positive(row, name):
    value = number(row, name)
    if not 0 < value < math.inf:
        raise Failure(f"{row['place']}: {row[name]!r}, expected a positive number for {name}")
    return value


def read_curves(path):
    """Of each sensor the axes, of each axis the lists tau, deviation, lower, upper, fitted."""
    sensors = {}
    for row in read(path, CURVES):
        axis = sensors.setdefault(row["sensor"], {}).setdefault(row["axis"], [])
        tau, deviation, lower, upper = positive(row, "tau"), *(number(row, name) for name in ("deviation", "lower", "upper"))
        fitted = positive(row, "fitted") if row["fitted"] not in ("", "nan") else math.nan
        if not 0 <= deviation < math.inf:
            raise Failure(f"{row['place']}: {row['deviation']!r}, expected a deviation of 0 or more")
        # Zero has no place on a logarithmic scale; and 200 points a decade are more than anybody sees.
        if deviation > 0 and (not axis or tau > axis[-1][0] * 10**0.005):
            axis.append((tau, deviation, max(deviation / 100, lower), min(deviation * 100, upper), fitted))
    for sensor, axes in sensors.items():
        for axis, rows in axes.items():
            if not rows:
                raise Failure(f"{path}: {sensor} {axis} is 0 at all times, nothing to draw")
    return {sensor: {axis: list(zip(*rows)) for axis, rows in axes.items()} for sensor, axes in sensors.items()}


def read_noise(path):
    """Of each sensor the terms, pooled over the axes if there are several."""
    sensors = {}
    for row in read(path, NOISE):
        if row["term"] not in LINES:
            raise Failure(f"{row['place']}: term {row['term']!r}, expected one of {', '.join(LINES)}")
        if row["detected"] not in ("0", "1"):
            raise Failure(f"{row['place']}: detected {row['detected']!r}, expected 0 or 1")
        row["value"] = positive(row, "estimate") if row["detected"] == "1" else number(row, "upper")
        row["unit"] = row["unit"].replace("sqrt(Hz)", "√Hz").replace("^2", "²").replace("^3", "³")
        terms = sensors.setdefault(row["sensor"], {})
        if row["axis"] == "all" or row["term"] not in terms:
            terms[row["term"]] = row
    return sensors


def figures(value, count):
    """0.0150, or 5.00×10⁻⁵"""
    if value == 0 or 1e-3 <= abs(value) < 1e5:
        return f"{value:#.{count}g}".rstrip(".") if value < 10**count else f"{value:.0f}"
    mantissa, exponent = f"{value:.{count - 1}e}".split("e")
    return f"{mantissa}×10{str(int(exponent)).translate(str.maketrans('-0123456789', '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'))}"


def estimate_text(sensor, term):
    text = f"{term['term']}  {figures(term['value'], 3)} {term['unit']}".strip()
    familiar = FAMILIAR.get((sensor, term["term"]))
    if familiar and term["unit"].startswith(UNITS[sensor]):
        text += f"  ({figures(term['value'] / familiar[0], 3)} {familiar[1]})"
    return text


def missing_text(terms):
    """The limits of the terms that were not found, two lines if they are all."""
    texts = [f"{name} < {figures(terms[name]['value'], 2)} {terms[name]['unit']}".strip()
             for name in LINES if name in terms and terms[name]["detected"] == "0"]
    if len(texts) > 3:
        texts[2] = "\n" + texts[2]
    return "not detected (95 %):  " + ",  ".join(texts).replace(",  \n", ",\n") if texts else ""


def limits_of(axes, detected):
    """The window: all of the curves, and of the points where coefficients are read what is near."""
    taus = [tau for axis in axes.values() for tau in axis[0]]
    lows = [max(low, deviation / 3) for axis in axes.values() for deviation, low in zip(axis[1], axis[2])]
    highs = [min(high, deviation * 3) for axis in axes.values() for deviation, high in zip(axis[1], axis[3])]
    left, right, bottom, top = min(taus), max(taus), min(lows), max(highs)
    floor = bottom / 1000
    for term in detected:
        factor, slope = LINES[term["term"]]
        value = term["value"] if slope else factor * term["value"]
        if value >= floor:
            bottom = min(bottom, value)
        top = max(top, min(value, 10 * top))
    margin = (right / left) ** 0.03
    return left / margin, right * margin, bottom / 10**0.35, top * 10**0.2


def draw_terms(plot, sensor, detected, window):
    """Their lines, and their labels, which are returned."""
    left, right, bottom, top = window
    labels = []
    for term in detected:
        factor, slope = LINES[term["term"]]
        value = term["value"]
        plot.plot([left, right], [factor * value * left**slope, factor * value * right**slope], color=GUIDE, linewidth=0.9,
                  linestyle=DOTTED, zorder=1.5)
        at, height = (factor ** (-1 / slope), value) if slope else (left, factor * value)
        if slope and left < at < right and bottom < height < top:
            plot.plot([at], [height], "o", color="black", markersize=5, zorder=5)
        elif slope:
            # Where the line is low in the window.
            height = bottom * (top / bottom) ** 0.2
            at = min(max((height / (factor * value)) ** (1 / slope), left), right)
            height = factor * value * at**slope
        label = plot.annotate(estimate_text(sensor, term), (at, height), textcoords="offset points", xytext=(0, 0), zorder=6,
                              bbox={"boxstyle": "round,pad=0.15", "facecolor": "white", "alpha": 0.8, "linewidth": 0})
        label.sides = SIDES[term["term"]]
        labels.append(label)
    return labels


def place_labels(plot, labels, points):
    """Each label on the side of its point where it covers no other label, stays inside and hides the least curve."""
    points = plot.transData.transform(points)
    taken = []

    def stand(label, side):
        up, right = side.startswith("upper"), side.endswith("right")
        label.set(position=(7 if right else -7, 3 if up else -3))
        label.set(ha="left" if right else "right", va="bottom" if up else "top")
        return label.get_window_extent().padded(5)

    def cost(label, side):
        box = stand(label, side)
        outside = not (plot.bbox.x0 < box.x0 and box.x1 < plot.bbox.x1 and plot.bbox.y0 < box.y0 and box.y1 < plot.bbox.y1)
        shared = (box.intersection(box, other) for other in taken)
        covered = sum(part.width * part.height for part in shared if part)
        return 1e6 * outside + covered + 50 * sum(box.contains(*point) for point in points)

    for label in labels:
        taken.append(stand(label, min(label.sides, key=lambda side: cost(label, side))))


def draw(curves, noise):
    import matplotlib.figure
    import matplotlib.lines
    import matplotlib.patches
    import matplotlib.ticker

    def line(**style):
        return matplotlib.lines.Line2D([], [], **style)

    count = len(curves)
    figure = matplotlib.figure.Figure(figsize=(12.8 if count > 1 else 8.5, 6.2), dpi=125, layout="constrained")
    names = list(dict.fromkeys(axis for axes in curves.values() for axis in axes))
    notes = {sensor: missing_text(noise.get(sensor, {})) for sensor in curves}
    note_lines = max(note.count("\n") + bool(note) for note in notes.values())
    labelled = []
    for plot, (sensor, axes) in zip(figure.subplots(1, count, squeeze=False)[0], curves.items()):
        terms = noise.get(sensor, {})
        detected = [terms[name] for name in LINES if name in terms and terms[name]["detected"] == "1"]
        window = limits_of(axes, detected)
        fits = {}
        for name, (tau, deviation, lower, upper, fitted) in axes.items():
            colour = COLOURS[names.index(name) % len(COLOURS)]
            plot.fill_between(tau, lower, upper, color=colour, alpha=0.2, linewidth=0, zorder=2)
            plot.plot(tau, deviation, color=colour, linewidth=1.8, zorder=3)
            fits[fitted] = tau
        for fitted, tau in fits.items():  # one, if the model is that of all axes
            plot.plot(tau, fitted, color="black", linewidth=1.3, linestyle="--", zorder=4)
        plot.set(xscale="log", yscale="log", xlim=window[:2], ylim=window[2:])
        points = [(row[0], value) for axis in axes.values() for row in zip(*axis) for value in row[1:4]]
        labelled.append((plot, draw_terms(plot, sensor, detected, window), points))

        plot.xaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}"))
        plot.set_xlabel("averaging time τ (s)")
        unit = UNITS.get(sensor) or (terms["B"]["unit"] if "B" in terms else "")
        plot.set_ylabel(f"Allan deviation ({unit})" if unit else "Allan deviation")
        plot.grid(True, which="major", color="0.82", linewidth=0.8)
        plot.grid(True, which="minor", color="0.92", linewidth=0.5)
        plot.set_axisbelow(True)
        plot.set_title(sensor.capitalize(), loc="left", fontsize=13, pad=8 + 12 * note_lines)
        plot.annotate(notes[sensor], (0, 1), xycoords="axes fraction", xytext=(0, 5), textcoords="offset points",
                      fontsize=8.5, color="0.3")

    entries = [line(color=COLOURS[i % len(COLOURS)], linewidth=1.8, label=name if name.isalpha() else f"column {name}")
               for i, name in enumerate(names)]
    entries.append(matplotlib.patches.Patch(color="0.5", alpha=0.35, linewidth=0, label="68 % interval"))
    if any(math.isfinite(value) for axes in curves.values() for axis in axes.values() for value in axis[4]):
        entries.append(line(color="black", linewidth=1.3, linestyle="--", label="identified model"))
    if any(term["detected"] == "1" for terms in noise.values() for term in terms.values()):
        entries.append(line(color=GUIDE, linewidth=0.9, linestyle=DOTTED, marker="o", markersize=5, markerfacecolor="black",
                            markeredgecolor="black", label="its terms, read at the dot"))
    figure.legend(handles=entries, loc="outside lower center", ncols=len(entries), frameon=False)
    figure.draw_without_rendering()  # now everything has its size
    for plot, labels, points in labelled:
        place_labels(plot, labels, points)
    return figure


if __name__ == "__main__":
    plotting.run_on_folder(__doc__, "with curves.csv and noise.csv, where the pictures go", "allan",
                           lambda folder: draw(read_curves(folder / "curves.csv"), read_noise(folder / "noise.csv")))

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what the program allan computed: FOLDER/allan.png and FOLDER/allan.svg.

    allan imu.csv --output FOLDER
    plot_allan.py FOLDER             # reads its csv files; needs matplotlib

The upper panels show the Allan deviation of each sensor, the lower ones the square root of its power spectral density.
"""
import math
import textwrap

import plotting
from plot_allan_files import read_curves, read_findings, read_noise, read_spectrum
from plot_allan_terms import (DOTTED, GUIDE, UNITS, detected_terms, draw_table, draw_terms, limits_of, place_labels,
                              shared_notes, shared_terms, unbroken)

COLOURS = [plotting.BLUE, plotting.RED, plotting.GREEN, plotting.PURPLE, plotting.ORANGE, plotting.SKY]
ALL, WARNING, NOTE = "black", "#A00000", "0.3"  # colours of a model of all axes and of texts
LEFT_OUT = {"facecolor": "0.45", "edgecolor": "0.35", "linewidth": 0.6}
MISFIT = {"facecolor": "#F0C000", "edgecolor": "#B89000", "linewidth": 0.6}
PALE = 0.35
NOTE_HEIGHT = 13  # points
CURVE = {"linewidth": 1.8}
MODEL = {"linewidth": 1.5, "linestyle": (0, (4, 2))}
WORDS = {  # words for one or two findings, words for more, their unit
    "excluded": ("left out", "bands left out", "Hz"),
    "step": ("step at", "steps", "s"),
    "freeze": ("frozen", "frozen spans", "s"),
    "disturbance": ("disturbed", "disturbances", "s"),
}


class Style:
    """The colours and labels of axes, the same in every panel."""

    def __init__(self, names):
        import matplotlib.colors
        self.colours = {name: COLOURS[i % len(COLOURS)] for i, name in enumerate(names)}
        self.dark = {name: tuple(0.6 * part for part in matplotlib.colors.to_rgb(colour))
                     for name, colour in self.colours.items()}
        self.labels = {name: name if name.isalpha() else f"column {name}" for name in names}


def of_axis(findings, axis, *kinds):
    return [finding for finding in findings if finding.kind in kinds and finding.axis in (axis, "all", "")]


def parts(x, y, strong):
    """Splits a line into its strong part and the rest, as (y with breaks, alpha). The rest reaches the strong part."""
    import numpy
    rest = ~strong
    beside = rest.copy()
    beside[1:] |= rest[:-1]
    beside[:-1] |= rest[1:]
    found = (numpy.where(strong, y, numpy.nan), 1), (numpy.where(beside, y, numpy.nan), PALE)
    return [(line, alpha) for line, alpha in found if numpy.isfinite(line).any()]


def draw_values(plot, x, y, lower, upper, colour):
    """A curve and its band; paler where the band is wider than a factor of two."""
    known = upper < 2 * lower
    for line, alpha in parts(x, y, known):
        plot.plot(x, line, color=colour, alpha=0.75 * alpha, zorder=3, **CURVE)
    for line, alpha in parts(x, lower, known):
        plot.fill_between(x, line, upper, color=colour, alpha=0.24 if alpha == 1 else 0.1, linewidth=0, zorder=2)


def draw_models(plot, lines, style):
    """Draws the model of each axis: x, y, and where it was fitted. If all axes share one model, it is drawn once."""
    import numpy
    first = next(iter(lines.values()), None)
    same = len(lines) > 1 and all(all(numpy.array_equal(a, b, equal_nan=True) for a, b in zip(first, other))
                                  for other in lines.values())
    for axis, (x, y, fitted) in ({"all": first} if same else lines).items():
        for line, alpha in parts(x, y, fitted):
            plot.plot(x, line, color=ALL if same else style.dark[axis], alpha=alpha, zorder=4, **MODEL)


def shade(plot, axes, findings, kinds, span, style):
    """Shades spans of x, darker if more axes have them. Open spans go to the edge of the panel. Returns whether any is
    drawn."""
    left, right = plot.get_xlim()
    drawn = False
    for axis in axes:
        for finding in of_axis(findings, axis, *kinds):
            begin, end = span(finding)
            begin, end = max(begin, left), min(end, right)
            if begin < end:
                plot.axvspan(begin, end, alpha=0.25 / len(axes), zorder=1, **style)
                drawn = True
    return drawn


def frequencies(finding):
    return (finding.start, math.inf if finding.kind == "unused" else finding.end)


def times(finding):
    """The averaging times of a band. A frequency f shows in the deviation at about 1/(2f)."""
    low, high = frequencies(finding)
    return 1 / (2 * high), 1 / (2 * low) if low > 0 else math.inf


def was_fitted(tau, findings, axis):
    import numpy
    unused = of_axis(findings, axis, "unused")
    fitted = tau >= max((1 / (2 * finding.start) for finding in unused if finding.start > 0), default=0) * (1 - 1e-9)
    for finding in of_axis(findings, axis, "misfit"):
        fitted &= ~((tau >= finding.start * (1 - 1e-9)) & (tau <= finding.end * (1 + 1e-9)))
    return fitted & numpy.isfinite(tau)


def draw_scales(plot, window, x_label, y_label):
    import matplotlib.ticker
    plot.set_axis_on()
    plot.set(xscale="log", yscale="log", xlim=window[:2], ylim=window[2:])
    plot.xaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    plot.yaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    plot.set_xlabel(x_label)
    plot.set_ylabel(y_label)
    plot.grid(True, which="major", color="0.82", linewidth=0.8)
    plot.grid(True, which="minor", color="0.92", linewidth=0.5)
    plot.set_axisbelow(True)


def draw_deviation(plot, sensor, axes, noise, findings, style):
    """Returns the labels of terms, the points that they should not cover, and which kinds of spans are drawn."""
    terms = shared_terms(noise)
    detected = detected_terms(terms)
    window = limits_of(axes, detected)
    unit = UNITS.get(sensor) or next((term["B"].unit for term in noise.values() if "B" in term), "")
    draw_scales(plot, window, "averaging time τ (s)", f"Allan deviation ({unit})" if unit else "Allan deviation")
    for axis, (tau, deviation, lower, upper, _) in axes.items():
        draw_values(plot, tau, deviation, lower, upper, style.colours[axis])
    draw_models(plot, {axis: (values[0], values[4], was_fitted(values[0], findings, axis))
                       for axis, values in axes.items()}, style)
    shaded = {"left out": shade(plot, axes, findings, ["excluded", "unused"], times, LEFT_OUT),
              "misfit": shade(plot, axes, findings, ["misfit"], lambda finding: (finding.start, finding.end), MISFIT)}
    points = [(row[0], value) for values in axes.values() for row in values.T for value in row[1:4]]
    return draw_terms(plot, sensor, detected, window), points, shaded


def draw_spectrum(plot, axes, noise, findings, style):
    import numpy
    every = numpy.concatenate(list(axes.values()), axis=1)
    frequency, density, lower, upper = every[:4]
    # The window does not extend to a few uncertain values far down.
    bottom = min(numpy.percentile(density, 5), lower.min(where=upper < 2 * lower, initial=math.inf))
    margin = max((frequency.max() / frequency.min()) ** 0.03, 1.1)
    unit = next((terms["N"].unit for terms in noise.values() if "N" in terms), "")
    top = numpy.minimum(upper, density * 3).max()
    # At least two decades, because only powers of ten have labels.
    middle, half = math.sqrt(bottom * top), max(1.4 * math.sqrt(top / bottom), 10)
    window = frequency.min() / margin, frequency.max() * margin, middle / half, middle * half
    draw_scales(plot, window, "frequency (Hz)", f"√PSD, two-sided\n({unit})" if unit else "√PSD, two-sided")
    for axis, (x, y, lower, upper, _, _) in axes.items():
        draw_values(plot, x, y, lower, upper, style.colours[axis])
    draw_models(plot, {axis: (values[0], values[4], values[5] > 0) for axis, values in axes.items()}, style)
    return shade(plot, axes, findings, ["excluded", "unused"], frequencies, LEFT_OUT)


def together(axes, style, text_of):
    """Texts of axes; axes with the same text share one: "x, y: text"."""
    groups = {}
    for axis in axes:
        if text := text_of(axis):
            groups.setdefault(text, []).append(style.labels[axis])
    return ["all axes: " + text if len(names) == len(axes) > 1 else f"{', '.join(names)}: {text}"
            for text, names in groups.items()]


def findings_text(kind, found):
    if not found:
        return ""
    if kind == "unused":
        return unbroken(f"left out above {found[0].start:.4g} Hz")
    one, many, unit = WORDS[kind]
    digits = 4 if unit == "Hz" else 6
    if len(found) > 2:
        return f"{len(found)} {many}, the first at {found[0].start:.{digits}g} {unit}"
    spans = [f"{finding.start:.{digits}g}" + (f" … {finding.end:.{digits}g}" if finding.end > finding.start else "")
             for finding in found]
    return unbroken(f"{one} {' and '.join(spans)} {unit}")


def notes_of(axes, noise, findings, style, width):
    """The lines above a panel, each with its colour."""
    adequacy = {axis: next(iter(terms.values())).adequacy for axis, terms in noise.items()}

    def text_of(axis):
        texts = ["described in part"] if adequacy.get(axis) == "partial" else []
        texts += [findings_text(kind, of_axis(findings, axis, kind)) for kind in ["unused", *WORDS]]
        return ", ".join(filter(None, texts))

    warnings = together(axes, style,
                        lambda axis: "model does not describe it" if adequacy.get(axis) == "inadequate" else "")
    lines = [("; ".join(warnings), WARNING), ("; ".join(together(axes, style, text_of)), NOTE)]
    lines += [(text, NOTE) for text in shared_notes(shared_terms(noise))]
    return [(part, colour) for text, colour in lines
            for part in textwrap.wrap(text, width, max_lines=2, placeholder=" …")]


def legend_entries(style, shaded, models, terms):
    import matplotlib.lines
    import matplotlib.patches
    line, patch = matplotlib.lines.Line2D, matplotlib.patches.Patch
    entries = [line([], [], color=style.colours[name], label=style.labels[name], **CURVE) for name in style.colours]
    entries.append(patch(color="0.5", alpha=0.35, linewidth=0, label="68 % interval"))
    if models:
        label = "model, pale where not fitted" if any(shaded.values()) else "model"
        entries.append(line([], [], color=ALL, label=label, **MODEL))
    if terms:
        entries.append(line([], [], color=GUIDE, linewidth=0.9, linestyle=DOTTED, marker="o", markersize=5,
                            markerfacecolor="black", markeredgecolor="black", label="its terms, read at the dot"))
    for name, label, style in (("left out", "left out", LEFT_OUT), ("misfit", "model and curve disagree", MISFIT)):
        if shaded[name]:
            entries.append(patch(alpha=0.25, label=label, **style))
    return entries


def layout(curves, spectrum, tables):
    """A figure, and for each sensor its panels from top to bottom: deviation, and spectrum and table if there are."""
    import matplotlib.figure
    heights = [4.6]
    if any(spectrum.values()):
        heights.append(2.1)
    if tables:
        heights.append(0.2 * (2 + max(map(len, tables.values()))))
    size = 12.8 if len(curves) > 1 else 8.5, 1.6 + sum(heights)
    figure = matplotlib.figure.Figure(figsize=size, dpi=125, layout="constrained")
    grid = figure.subplots(len(heights), len(curves), squeeze=False, gridspec_kw={"height_ratios": heights})
    for panel in grid[1:].flat:
        panel.set_axis_off()  # until it is drawn
    return figure, dict(zip(curves, grid.T))


def write_notes(plot, sensor, notes, height):
    """Writes the title of a panel, with room for `height` lines below it, and the lines."""
    plot.set_title(sensor.capitalize(), loc="left", fontsize=13, pad=8 + NOTE_HEIGHT * height)
    for i, (text, colour) in enumerate(notes, 1):
        plot.annotate(text, (0, 1), xycoords="axes fraction", xytext=(0, 5 + NOTE_HEIGHT * (height - i)),
                      textcoords="offset points", fontsize=9.5, color=colour, parse_math=False, in_layout=False)


def draw(curves, noise, spectrum, title, findings):
    import numpy
    style = Style(list(dict.fromkeys(axis for axes in curves.values() for axis in axes)))
    tables = {sensor: {axis: terms for axis, terms in noise[sensor].items() if axis in curves[sensor]}
              for sensor in curves if noise.get(sensor) and not shared_terms(noise[sensor])}
    figure, panels = layout(curves, spectrum, tables)
    notes = {sensor: notes_of(axes, noise.get(sensor, {}), findings.get(sensor, []), style, 78 if len(curves) > 1 else 105)
             for sensor, axes in curves.items()}
    labelled, shaded = [], {"left out": False, "misfit": False}
    for sensor, axes in curves.items():
        terms, found = noise.get(sensor, {}), findings.get(sensor, [])
        deviation, *others = panels[sensor]
        labels, points, there = draw_deviation(deviation, sensor, axes, terms, found, style)
        labelled.append((deviation, labels, points))
        write_notes(deviation, sensor, notes[sensor], max(map(len, notes.values())))
        if spectrum.get(sensor):
            there["left out"] |= draw_spectrum(others[0], spectrum[sensor], terms, found, style)
        if sensor in tables:
            draw_table(others[-1], sensor, tables[sensor], style.colours, style.labels)
        shaded = {name: shaded[name] or there[name] for name in shaded}

    models = any(numpy.isfinite(values[4]).any() for axes in curves.values() for values in axes.values())
    entries = legend_entries(style, shaded, models, any(labels for _, labels, _ in labelled))
    rows = math.ceil(len(entries) / (9 if len(curves) > 1 else 5))
    figure.legend(handles=entries, loc="outside lower center", ncols=math.ceil(len(entries) / rows), frameon=False)
    if title:
        figure.suptitle(textwrap.shorten(title, 110, placeholder=" …"), x=0.01, ha="left", fontsize=12, parse_math=False)
    figure.draw_without_rendering()  # sets all sizes
    for plot, labels, points in labelled:
        place_labels(plot, labels, points)
    return figure


def draw_folder(folder):
    return draw(read_curves(folder / "curves.csv"), read_noise(folder / "noise.csv"),
                read_spectrum(folder / "spectrum.csv"), *read_findings(folder / "findings.csv"))


if __name__ == "__main__":
    plotting.run_on_folder(__doc__, "folder with the csv files of allan, also for the pictures", "allan", draw_folder)

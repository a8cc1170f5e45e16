# SPDX-License-Identifier: MIT
"""Noise terms in the plot of the Allan deviation: as lines with labels if the axes share them, else as a table."""
import dataclasses
import math

from plot_allan_files import STATUSES, TERMS

# The Allan deviation of a coefficient of 1 at 1 s, and the slope. A coefficient can be read off its line at the time
# where the line has the coefficient's value.
LINES = {
    "Q": (math.sqrt(3), -1),
    "N": (1, -0.5),
    "B": (math.sqrt(2 * math.log(2) / math.pi), 0),
    "K": (1 / math.sqrt(3), 0.5),
    "R": (1 / math.sqrt(2), 1),
}
SIDES = {  # where the label may be relative to the point on the line, the best first
    "Q": ["lower left", "upper right", "upper left", "lower right"],
    "N": ["upper right", "lower left", "upper left", "lower right"],
    "B": ["upper right", "lower right"],
    "K": ["lower right", "upper left", "lower left", "upper right"],
    "R": ["lower right", "upper left", "lower left", "upper right"],
    "G": ["upper left", "upper right", "lower right", "lower left"],
}
DEGREE, MICRO_G = math.pi / 180, 9.80665e-6
FLOOR = math.sqrt(2 * math.log(2) / math.pi)  # floor of the curve/B; data sheets call the floor bias instability
FAMILIAR = {  # units of data sheets
    ("gyroscope", "N"): (DEGREE / 60, "°/√h"),
    ("gyroscope", "B"): (DEGREE / 3600 / FLOOR, "°/h, floor"),
    ("accelerometer", "N"): (1 / 60, "m/s/√h"),
    ("accelerometer", "B"): (MICRO_G / FLOOR, "µg, floor"),
}
UNITS = {"gyroscope": "rad/s", "accelerometer": "m/s²"}
GUIDE, DOTTED = "0.45", (0, (1, 1.5))
WIDEST_TABLE = 6.7  # in widths of a column with one number


def shared_terms(axes):
    """The terms that all axes have in common, {} if there are none."""
    return axes.get("all") or (next(iter(axes.values())) if len(axes) == 1 else {})


def detected_terms(terms):
    return [terms[name] for name in TERMS if name in terms and terms[name].status == "detected"]


def figures(value, count):
    """0.0150, or 5.00×10⁻⁵"""
    if value == 0 or 1e-3 <= abs(value) < 1e5:
        return f"{value:#.{count}g}".rstrip(".") if value < 10**count else f"{value:.0f}"
    mantissa, exponent = f"{value:.{count - 1}e}".split("e")
    return f"{mantissa}×10{str(int(exponent)).translate(str.maketrans('-0123456789', '⁻⁰¹²³⁴⁵⁶⁷⁸⁹'))}"


def familiar_unit(sensor, term):
    """The value of a coefficient of 1 in the unit of data sheets, and the name of this unit."""
    size, unit = FAMILIAR.get((sensor, term.name), (1, ""))
    return (1 / size, unit) if term.unit.startswith(UNITS.get(sensor, term.unit)) else (1, "")


def value_text(term, unit=""):
    """The value of a detected term or the limit of another one, and its time if it has one."""
    detected = term.status == "detected"
    number = term.value if detected else term.limit
    if not math.isfinite(number):
        return ""
    time = f", {figures(term.time, 2)} s" if math.isfinite(term.time) else ""
    return f"{'' if detected else '< '}{figures(number, 3 if detected and not time else 2)}{unit}{time}"


def estimate_text(sensor, term):
    text = f"{term.name}  {value_text(term, f' {term.unit}'.rstrip())}"
    factor, unit = familiar_unit(sensor, term)
    return text + (f"  ({figures(term.value * factor, 3)} {unit})" if unit else "")


def unbroken(text):
    """The text with no-break spaces."""
    return text.replace(" ", "\N{NO-BREAK SPACE}")


def shared_notes(terms):
    """Notes about shared terms that have no line in the plot."""
    def listed(status, title, text):
        texts = [unbroken(text(term)) for term in terms.values() if term.status == status]
        return [f"{title}: {', '.join(found)}"] if (found := list(filter(None, texts))) else []

    def whole(term):
        return f"{term.name} {value_text(term, f' {term.unit}'.rstrip())}".rstrip()

    return (listed("detected", "warm-up", lambda term: whole(term) if term.name == "W" else "") +
            listed("possible", "possible", whole) +
            listed("absent", "not detected", lambda term: whole(term) if math.isfinite(term.limit) else ""))


def gauss_markov_deviation(term, tau):
    """Allan deviation of an exponentially correlated bias (IEEE Std 952-1997, annex C)."""
    ratio = tau / term.time
    if ratio < 1e-3:
        return term.value * math.sqrt(2 * ratio / 3)
    change = 1 - (3 - 4 * math.exp(-ratio) + math.exp(-2 * ratio)) / (2 * ratio)
    return term.value * math.sqrt(2 * change / ratio)


def reading_point(term):
    """Where the coefficient is read off its line: averaging time and deviation. The time is None for a flat line."""
    if term.name == "G":  # the maximum, about 0.62 of the standard deviation
        return 1.89 * term.time, gauss_markov_deviation(term, 1.89 * term.time)
    factor, slope = LINES[term.name]
    return (factor ** (-1 / slope), term.value) if slope else (None, factor * term.value)


def limits_of(axes, detected):
    """The window: it contains the curves, and the points where coefficients are read if they are near."""
    taus = [tau for values in axes.values() for tau in values[0]]
    lows = [max(low, deviation / 3) for values in axes.values() for deviation, low in zip(values[1], values[2])]
    highs = [min(high, deviation * 3) for values in axes.values() for deviation, high in zip(values[1], values[3])]
    left, right, bottom, top = min(taus), max(taus), min(lows), max(highs)
    floor = bottom / 1000
    for term in detected:
        if term.name == "W":
            continue
        height = reading_point(term)[1]
        if height >= floor:
            bottom = min(bottom, height)
        top = max(top, min(height, 10 * top))
    margin = max((right / left) ** 0.03, 1.1)
    return left / margin, right * margin, bottom / 10**0.35, top * 10**0.2


def draw_terms(plot, sensor, detected, window):
    """Draws the lines and the labels of the terms. Returns the labels."""
    left, right, bottom, top = window
    labels = []
    for term in detected:
        if term.name == "W":
            continue
        if term.name == "G":
            taus = [left * (right / left) ** (i / 100) for i in range(101)]
            heights = [gauss_markov_deviation(term, tau) for tau in taus]
        else:
            factor, slope = LINES[term.name]
            taus = [left, right]
            heights = [factor * term.value * tau**slope for tau in taus]
        plot.plot(taus, heights, color=GUIDE, linewidth=0.9, linestyle=DOTTED, zorder=1.5)
        at, height = reading_point(term)
        if at is None:
            at = left
        elif left < at < right and bottom < height < top:
            plot.plot([at], [height], "o", color="black", markersize=5, zorder=5)
        elif term.name == "G":
            at = min(max(at, left), right)
            height = gauss_markov_deviation(term, at)
        else:
            # A point where the line is low in the window.
            height = bottom * (top / bottom) ** 0.2
            at = min(max((height / (factor * term.value)) ** (1 / slope), left), right)
            height = factor * term.value * at**slope
        label = plot.annotate(estimate_text(sensor, term), (at, height), textcoords="offset points", xytext=(0, 0), zorder=6,
                              color="black" if term.adequacy != "inadequate" else "0.5",
                              bbox={"boxstyle": "round,pad=0.15", "facecolor": "white", "alpha": 0.8, "linewidth": 0})
        label.sides = SIDES[term.name]
        labels.append(label)
    return labels


def place_labels(plot, labels, points):
    """Puts each label on the side of its point where it covers no other label, stays inside and hides the least of the
    curves."""
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


def table_columns(sensor, axes):
    """(name, unit, width, function for the text of a term) of each column: detected terms first, as many as fit."""
    columns = []
    for status in "detected", "possible":
        for name in TERMS:
            found = [terms[name] for terms in axes.values() if name in terms]
            best = min((term.status for term in found), key=STATUSES.index, default="absent")
            if best != status:
                continue
            timed = name in ("G", "W")
            width = 1 + 0.6 * timed + 0.25 * any(term.status == "possible" for term in found)
            columns.append((name, found[0].unit + (", s" if timed else ""), width, value_text))
            factor, unit = familiar_unit(sensor, found[0])
            if unit:
                columns.append(("", unit, 0.9, lambda term, factor=factor: value_text(
                    dataclasses.replace(term, value=factor * term.value, limit=factor * term.limit))))
    if sum(column[2] for column in columns) > WIDEST_TABLE:
        columns = [column for column in columns if column[0]]
    all_columns = len(columns)
    while sum(column[2] for column in columns) > WIDEST_TABLE:
        columns.pop()
    if len(columns) < all_columns:
        columns.append(("…", "", 0.3, None))
    return columns


def draw_table(plot, sensor, axes, colours, labels):
    """Draws a table of the detected and possible terms, one row per axis. Possible terms have a question mark."""
    plot.set_axis_off()

    def write(place, row, text, **style):
        height = 1 - (row + 0.5) / (len(axes) + 2)
        plot.text(place, height, text, transform=plot.transAxes, va="center", fontsize=9, **style)

    columns = table_columns(sensor, axes)
    whole = max(sum(column[2] for column in columns), 5)
    for row, axis in enumerate(axes, 2):
        write(0, row, labels[axis], ha="left", weight="bold", color=colours[axis])
    place = 0.06
    for i, (name, unit, width, text) in enumerate(columns):
        place += 0.94 * width / whole
        name = name or columns[i - 1][0]
        write(place, 0, name, ha="right", weight="bold")
        write(place, 1, unit, ha="right", color="0.35")
        if not text:
            continue
        for row, terms in enumerate(axes.values(), 2):
            term = terms.get(name)
            known = term and term.status != "absent"
            write(place, row, f"{text(term)}{' ?' if term.status == 'possible' else ''}" if known else "–", ha="right",
                  color="0.55" if known and term.adequacy == "inadequate" else "black")

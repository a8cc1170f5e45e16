# SPDX-License-Identifier: MIT
"""Reads the csv files of the program allan."""
import csv
import dataclasses
import math

from plotting import Failure

CURVES = "#sensor,axis,m,tau [s],terms,deviation,lower,upper,alpha,fitted"
OLD_NOISE = "#sensor,axis,term,detected,estimate,lower,upper,standard_error,unit"
NOISE = OLD_NOISE + ",time,time_lower,time_upper,status,adequacy"
SPECTRUM = "#sensor,axis,frequency [Hz],density,fitted,count,used"
FINDINGS = "#sensor,axis,kind,from,to,unit,text"

TERMS = ["N", "K", "B", "Q", "R", "G", "W"]
STATUSES = ["detected", "possible", "absent"]
ADEQUACIES = ["adequate", "partial", "inadequate"]
SPANS = ["excluded", "unused", "misfit", "step", "freeze", "disturbance"]  # kinds of findings that are drawn


@dataclasses.dataclass
class Term:
    """A noise term of an axis: a detected one has a value, the others a limit, which may be nan."""
    name: str
    status: str
    value: float
    limit: float
    unit: str
    time: float  # s, of G and W
    adequacy: str


@dataclasses.dataclass
class Finding:
    axis: str
    kind: str
    start: float  # Hz or s
    end: float


def read(path, *headers, empty=False):
    """The rows of a file with one of the headers, as dictionaries."""
    rows, names = [], []
    with open(path, newline="", encoding="utf-8", errors="replace") as file:
        for count, row in enumerate(csv.reader(file), 1):
            if count == 1:
                header = ",".join(row)
                if header not in headers:
                    raise Failure(f"{path}:1: {header[:60]!r}, expected the header {headers[0]}")
                names = [name.split(" ")[0] for name in header[1:].split(",")]
                continue
            if len(row) != len(names):
                raise Failure(f"{path}:{count}: {len(row)} columns, expected {len(names)}: {header[1:]}")
            rows.append(dict(zip(names, row), place=f"{path}:{count}"))
    if not names or not (rows or empty):
        raise Failure(f"{path}: no rows, expected {headers[0][1:]}")
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


def not_negative(row, name):
    value = number(row, name)
    if not 0 <= value < math.inf:
        raise Failure(f"{row['place']}: {row[name]!r}, expected a {name} of 0 or more")
    return value


def one_of(row, name, choices):
    if row[name] not in choices:
        raise Failure(f"{row['place']}: {name} {row[name]!r}, expected one of {', '.join(choices)}")
    return row[name]


def number_or_nan(row, name):
    return number(row, name) if row.get(name) else math.nan


def fitted_or_nan(row):
    return positive(row, "fitted") if row["fitted"] not in ("", "nan", "0") else math.nan


def by_axis(rows, columns):
    """{sensor: {axis: columns as arrays}}. columns(row) is None if the row is not to be drawn."""
    import numpy
    sensors = {}
    for row in rows:
        axis = sensors.setdefault(row["sensor"], {}).setdefault(row["axis"], [])
        if values := columns(row):
            axis.append(values)

    def thinned(values):
        kept = []
        for point in sorted(values):
            # 200 points per decade are enough for a plot.
            if not kept or point[0] > kept[-1][0] * 10**0.005:
                kept.append(point)
        return numpy.array(kept).T

    return {sensor: {axis: thinned(values) for axis, values in axes.items()} for sensor, axes in sensors.items()}


def read_curves(path):
    """{sensor: {axis: the rows tau, deviation, lower, upper, fitted}}."""
    def columns(row):
        tau, lower, upper = positive(row, "tau"), number(row, "lower"), number(row, "upper")
        deviation, fitted = not_negative(row, "deviation"), fitted_or_nan(row)
        if deviation == 0:  # cannot be drawn on a logarithmic scale
            return None
        return tau, deviation, max(deviation / 100, lower), min(deviation * 100, upper), fitted

    sensors = by_axis(read(path, CURVES), columns)
    for sensor, axes in sensors.items():
        for axis, values in axes.items():
            if not values.size:
                raise Failure(f"{path}: {sensor} {axis} is 0 at all times, nothing to draw")
    return sensors


def read_spectrum(path):
    """{sensor: {axis: the rows frequency, density, lower, upper, fitted, used}}; empty if there is no such file.
    Squared densities are chi-square distributed; their 68 % quantiles are the approximation of Wilson and Hilferty."""
    def columns(row):
        frequency, density, fitted = positive(row, "frequency"), not_negative(row, "density"), fitted_or_nan(row)
        count, used = positive(row, "count"), one_of(row, "used", ["0", "1"])
        if density == 0:
            return None
        width = 2 / (9 * count)
        low, high = (max(1 - width + sign * math.sqrt(width), 0.1) ** 1.5 for sign in (1, -1))
        return frequency, density, density / low, density / high, fitted, float(used)

    if not path.exists():
        return {}
    sensors = by_axis(read(path, SPECTRUM), columns)
    return {sensor: {axis: values for axis, values in axes.items() if values.size} for sensor, axes in sensors.items()}


def read_noise(path):
    """{sensor: {axis: {name: term}}}."""
    sensors = {}
    for row in read(path, NOISE, OLD_NOISE):
        name = one_of(row, "term", TERMS)
        detected = one_of(row, "detected", ["0", "1"]) == "1"
        status = one_of(row, "status", STATUSES) if "status" in row else "detected" if detected else "absent"
        value = positive(row, "estimate") if status == "detected" else number(row, "estimate")
        time = positive(row, "time") if name in ("G", "W") and status == "detected" else number_or_nan(row, "time")
        adequacy = one_of(row, "adequacy", ADEQUACIES) if "adequacy" in row else "adequate"
        unit = row["unit"].replace("sqrt(Hz)", "√Hz").replace("^2", "²").replace("^3", "³")
        axes = sensors.setdefault(row["sensor"], {})
        axes.setdefault(row["axis"], {})[name] = Term(name, status, value, number(row, "upper"), unit, time, adequacy)
    return sensors


def read_findings(path):
    """The title, and {sensor: findings that are drawn}. Both are empty if there is no such file."""
    title, sensors = "", {}
    if not path.exists():
        return title, sensors
    for row in read(path, FINDINGS, empty=True):
        if row["kind"] == "log":
            title = title or " ".join(row["text"].split())
        elif row["kind"] in SPANS:
            start, end = number(row, "from"), number_or_nan(row, "to")
            if end < start or not math.isfinite(start):
                raise Failure(f"{row['place']}: from {row['from']} to {row['to']}, expected a span")
            if start > 0 or end > 0:  # else it is a remark about all of the log
                sensors.setdefault(row["sensor"], []).append(Finding(row["axis"], row["kind"], start, end))
    return title, sensors

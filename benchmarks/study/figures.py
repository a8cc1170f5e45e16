# SPDX-License-Identifier: MIT
"""The csv files of the study: what the tables and plots use of the programs' output, with five digits.

Errors stand in a row for all knot intervals, or rates, which are the names of the last columns."""
from results import GRADES, SCENES, Integrators, Representation, range_of
from tables import read_csv, write_csv

KEPT = {  # columns of the files that are kept as they are
    "error_terms": ("model", "axes", "ns_median", "extra_ns_min", "extra_ns_median", "extra_ns_max"),
    "allan": ("grid", "deviation", "samples", "taus", "ns_min", "white_relative_error", "walk_relative_error",
              "white_coverage", "walk_coverage", "estimate_ms"),
}
SERIES = ("scene", "quantity", "group", "scalar", "order")
KIND = ("group", "scalar", "order", "way")


def short(value):
    return "" if value is None else f"{value:.5g}" if isinstance(value, float) else value


def write(path, columns, rows):
    write_csv(path, [short(column) for column in columns],
              [[short(row.get(column)) for column in columns] for row in rows])


def widened(rows, keys, along, value):
    """A row for each combination of the keys, with the values along a column beside each other."""
    wide = {}
    for row in rows:
        wide.setdefault(tuple(row[key] for key in keys), {})[row[along]] = row[value]
    return [{**dict(zip(keys, key)), **values} for key, values in wide.items()]


def narrowed(rows, keys, along, value):
    """The reverse of widened()."""
    return [{**{key: row[key] for key in keys}, along: float(column), value: row[column]}
            for row in rows for column in row if column not in keys and row[column] is not None]


def curve_times(rows, intervals):
    """A row for each kind of curve and way to evaluate it."""
    kinds = {}
    for row in rows:
        kinds.setdefault((row["group"], row["scalar"], row["order"]), []).append(row)
    times = []
    for kind, some in kinds.items():
        for way in ("single", "dense"):
            smallest, median, largest = range_of(some, f"{way}_")
            at = {interval: min(row[f"{way}_ns_min"] for row in some if row["knot_interval"] == interval)
                  for interval in intervals if kind[1] != "long double"}
            times.append({**dict(zip(KIND, (*kind, way))), **at,
                          "ns_min": smallest, "ns_median": median, "ns_max": largest})
    return times


def curve_errors(rows, data):
    """Rows of one quantity: f and ω for the plots, of one curve in all scalars, and all for the table of errors."""
    for row in rows:
        scene, exact = row["scene"], row["scalar"] == "double"
        compared = (row["group"], row["order"]) == ("SO3xR3", 6) and scene in ("wheeled_robot", data.scenes[0])
        kept = ["accel_rms"] if row["scalar"] != "long double" or compared else []
        kept += ["gyro_rms"] if row["scalar"] != "long double" else []
        if exact and row["knot_interval"] == data.table_interval(scene):
            kept += ["gyro_max", "accel_max", "position_rms", "position_max", "orientation_rms", "orientation_max",
                     "bytes_per_second"]
        for quantity in kept:
            yield {**{key: row.get(key) for key in SERIES}, "quantity": quantity,
                   "knot_interval": row["knot_interval"], "value": row[quantity]}


def thin_representation(raw, folder):
    rows = read_csv(raw / "representation.csv")
    intervals = sorted({row["knot_interval"] for row in rows}, reverse=True)
    times = curve_times(rows, intervals)
    errors = list(curve_errors(rows, Representation(rows, times)))
    errors.sort(key=lambda row: (list(SCENES).index(row["scene"]), row["quantity"]))  # keeps the order of the rest
    write(folder / "curve_times.csv", (*KIND, "ns_min", "ns_median", "ns_max", *intervals), times)
    write(folder / "curve_errors.csv", (*SERIES, *intervals), widened(errors, SERIES, "knot_interval", "value"))


def thin_integrators(raw, folder):
    rows = read_csv(raw / "integrators.csv")
    rates = sorted({row["rate"] for row in rows})
    schemes = dict.fromkeys(row["scheme"] for row in rows)
    times = [(scheme, range_of([row for row in rows if row["scheme"] == scheme], "")) for scheme in schemes]
    errors = [row for row in rows if row["grade"] == "none"]
    for scene in dict.fromkeys(row["scene"] for row in rows):
        for grade in GRADES:
            for rate in rates:
                least = min(row["position_rms"] for row in rows
                            if (row["scene"], row["grade"], row["rate"]) == (scene, grade, rate))
                errors.append({"scene": scene, "grade": grade, "rate": rate, "scheme": "best", "position_rms": least})
    keys = ("scene", "grade", "scheme")
    write(folder / "integrator_errors.csv", (*keys, *rates), widened(errors, keys, "rate", "position_rms"))
    write(folder / "integrator_times.csv", ("scheme", "ns_min", "ns_median", "ns_max"),
          [dict(zip(("scheme", "ns_min", "ns_median", "ns_max"), (scheme, *three))) for scheme, three in times])


def thin(raw, folder):
    """Writes the csv files of the study into the folder from what the program has written into the folder `raw`."""
    thin_representation(raw, folder)
    thin_integrators(raw, folder)
    for name, columns in KEPT.items():
        write(folder / f"{name}.csv", columns, read_csv(raw / f"{name}.csv"))


def read_representation(folder):
    rows = {}
    keys = ("scene", "group", "scalar", "order", "knot_interval")
    for row in narrowed(read_csv(folder / "curve_errors.csv"), SERIES, "knot_interval", "value"):
        key = tuple(row[key] for key in keys)
        rows.setdefault(key, dict(zip(keys, key)))[row["quantity"]] = row["value"]
    times = [{column if column in KIND or column.startswith("ns") else float(column): value
              for column, value in row.items()} for row in read_csv(folder / "curve_times.csv")]
    return Representation(list(rows.values()), times)


def read_integrators(folder):
    errors = narrowed(read_csv(folder / "integrator_errors.csv"), ("scene", "grade", "scheme"), "rate", "position_rms")
    return Integrators(errors, read_csv(folder / "integrator_times.csv"))

# SPDX-License-Identifier: MIT
"""The sections of the page, and the page with its plots."""
import csv
import pathlib
import sys

from curve_plots import draw_knots, draw_pareto
from figures import KEPT, read_integrators, read_representation
from integrator_plots import draw_integrators_pareto, draw_integrators_rates
from other_plots import draw_allan, draw_error_terms
from plots import set_style
from results import (ACCEL_NOISE, GRADES, GROUPS, GYRO_NOISE, INCREMENT_SCHEMES, ORDERS, POINT_SCHEMES, RATE, SCENES,
                     choice_text, log_text, seconds_text)
from tables import number, read_csv, reflow, spread, table
from texts import ALLAN, CHOICES, COMPILING, ERROR_TERMS, INTEGRATORS, PAGE_HEAD, REPRESENTATION

def table_of_orders(data):
    """The smallest order that is good enough, for each scene and knot interval."""
    rows = []
    for scene in data.scenes:
        row = [SCENES[scene]]
        for interval in data.intervals:
            good = (r["order"] for r in data.find(scene=scene, group="SO3xR3", scalar="double", knot_interval=interval)
                    if data.good_enough(r))
            pick = min(good, default=None)
            row.append("—" if pick is None else f"{pick:.0f}")
        rows.append(row)
    return table(["knots, s", *map(seconds_text, data.intervals)], rows)


def table_of_costs(data, folder):
    instructions = {(row["group"], row["scalar"], row["order"], row["way"]): row["instructions"]
                    for row in read_csv(folder / "instructions.csv")}
    compiling = {(row["group"], row["order"]): row["cpu_s_min"] for row in read_csv(folder / "compile.csv")
                 if row["what"] == "evaluate" and row["scalar"] == "double"}
    rows = []
    for group, scalar in (("SO3xR3", "double"), ("SE3", "double"), ("SO3xR3", "float"), ("SE3", "float")):
        for order in ORDERS:
            seen = dict(group=group, order=order, scalar=scalar)
            rows.append([f"{GROUPS[group]}, {scalar}", order, spread(data.times("single", **seen)),
                         spread(data.times("dense", **seen)),
                         number(instructions.get((group, scalar, order, "single")), 4),
                         number(instructions.get((group, scalar, order, "dense")), 3),
                         number(compiling.get((group, order))) if scalar == "double" else ""])
    return table(["", "order", "one by one, ns", "`sample_imu()`, ns", "instructions", "`sample_imu()`, instructions",
                  "compiling, s"], rows)


def table_of_errors(data):
    """The table, and by how much SE(3)'s error of f is larger at order 6, for each scene."""
    def rms_and_max(row, what):
        return f"{number(row[f'{what}_rms'])} ({number(row[f'{what}_max'])})"
    rows, ratios = [], {}
    for scene in data.scenes:
        interval = data.table_interval(scene)
        for order in ORDERS:
            split, rigid = (data.one(scene=scene, group=g, scalar="double", order=order, knot_interval=interval)
                            for g in ("SO3xR3", "SE3"))
            if order == 6:
                ratios[scene] = rigid["accel_rms"] / split["accel_rms"]
            rows.append([f"{SCENES[scene]}, {seconds_text(interval)} s" if order == 3 else "", order,
                         *(rms_and_max(split, what) for what in ("orientation", "position", "gyro", "accel")),
                         *(rms_and_max(rigid, what) for what in ("position", "accel"))])
    header = ["scene, knots", "order", "orientation, rad", "position, m", "ω, rad/s", "f, m/s²", "SE(3): position, m",
              "f, m/s²"]
    return table(header, rows), ratios


def table_of_scalars(data):
    scene = "wheeled_robot" if "wheeled_robot" in data.scenes else data.scenes[0]
    rows = []
    for scalar in ("float", "double", "long double"):
        curve = dict(scene=scene, group="SO3xR3", scalar=scalar, order=6)
        rows.append([scalar, *(number(data.one(knot_interval=i, **curve)["accel_rms"]) for i in data.intervals)])
    return table(["", *map(seconds_text, data.intervals)], rows)


def time_ratio(data, way, group="SO3xR3", scalar="double"):
    """Times over those of SO(3) × R³ in double, as the range over the orders."""
    ratios = [data.times(way, group=group, order=order, scalar=scalar)[0]
              / data.times(way, group="SO3xR3", order=order, scalar="double")[0] for order in ORDERS]
    low, high = number(min(ratios)), number(max(ratios))
    return low if low == high else f"{low} to {high}"


def representation_section(data, folder, machine):
    measured = (f"| measured flight | {machine['data']}: a curve of order 6 with knots 0.02 s apart, fitted to it |\n"
                if "measured" in data.scenes else "")
    errors, ratios = table_of_errors(data)
    last = sorted(data.find(scene=data.scenes[0], group="SO3xR3", scalar="double", order=8),
                  key=lambda row: -row["knot_interval"])
    curve = dict(group="SO3xR3", scalar="double")
    single, dense = ((data.times(way, order=8, **curve)[0] - data.times(way, order=3, **curve)[0]) / 5
                     for way in ("single", "dense"))
    note = f"\n{machine['note']}\n" if machine.get("note") else ""
    return REPRESENTATION.format(
        group=GROUPS["SO3xR3"], orders=table_of_orders(data), cost=table_of_costs(data, folder) + "\n" + note,
        errors=errors, scalars=table_of_scalars(data), measured=measured,
        per_order=f"about {number(single)} ns per sample ({number(dense)} in `sample_imu()`)",
        last_halving=number(last[-2]["gyro_rms"] / last[-1]["gyro_rms"]),
        ratios=", ".join(f"{number(ratio)} ({SCENES[scene]})" for scene, ratio in ratios.items()),
        time_ratio=time_ratio(data, "single", group="SE3"),
        float_single=time_ratio(data, "single", scalar="float"), float_dense=time_ratio(data, "dense", scalar="float"),
        long_single=time_ratio(data, "single", scalar="long double"),
        long_dense=time_ratio(data, "dense", scalar="long double"))


def integrators_section(data):
    rows = []
    for scene in data.scenes:
        for grade in GRADES:
            row = [f"{SCENES[scene]}, {grade}"]
            for rate in data.rates:
                names = [data.cheapest(scene, grade, rate, schemes) or "—"
                         for schemes in (POINT_SCHEMES, INCREMENT_SCHEMES)]
                row.append(f"{names[0]} ({names[1].removesuffix('Increments')})")
            rows.append(row)
    cheapest = table(["", *(f"{rate:g} Hz" for rate in data.rates)], rows)
    rate = RATE if RATE in data.rates else data.rates[-1]
    rows = [[scheme, spread(data.times(scheme)),
             *(number(data.error[scene, "none", rate, scheme]) for scene in data.scenes)] for scheme in data.schemes]
    rows += [[f"noise alone, {grade}", "", *(number(data.floor(scene, grade, rate)) for scene in data.scenes)]
             for grade in GRADES]
    cost = table(["", "ns per sample", *(f"{SCENES[scene]}, m" for scene in data.scenes)], rows)
    worse = [data.error[scene, "none", rate, "Euler"] / data.error[scene, "none", rate, "Midpoint"]
             for scene in data.scenes]
    return INTEGRATORS.format(
        cheapest=cheapest, cost=cost, rate=rate, fourth="RungeKutta4DoubleStep",
        euler_saves=number(data.times("Midpoint")[0] - data.times("Euler")[0]),
        euler_worse=f"{number(min(worse))} to {number(max(worse))}",
        grades="consumer MPU-6050, industrial ADIS16448, tactical STIM300, without turn-on bias (as within a run)")


def error_terms_section(rows):
    empty = next(row for row in rows if row["model"] == "ErrorModel{}")
    white = next(row for row in rows if row["model"] == "WhiteNoise")
    lines = [[row["model"], f"{row['axes']:.0f}",
              f"{number(row['extra_ns_median'])} ({number(row['extra_ns_min'])} to {number(row['extra_ns_max'])})"]
             for row in rows if row is not empty]
    return ERROR_TERMS.format(empty=f"{number(empty['ns_median'])} ns", white=number(white["extra_ns_median"]),
                              table=table(["model", "axes", "ns, median (smallest to largest)"], lines))


def allan_section(rows):
    logs = sorted({row["samples"] for row in rows})
    find = {(row["samples"], row["deviation"], row["grid"]): row for row in rows}
    grids = [grid for grid in dict.fromkeys(row["grid"] for row in rows) if grid != "none"]
    deviations = [name for name in dict.fromkeys(row["deviation"] for row in rows) if name != "identify"]
    costs = []
    for samples in logs:
        lines = []
        for grid in grids:
            there = [find[samples, name, grid] if (samples, name, grid) in find else None for name in deviations]
            if any(there):
                taus = max(row["taus"] for row in there if row)
                lines.append([grid, f"{taus:.0f}", *(number(row["ns_min"]) if row else "" for row in there)])
        costs.append(table([log_text(samples), "averaging times", *deviations], lines))
    estimates = [row for row in rows if row["white_relative_error"] is not None]
    lines = []
    for name, grid in dict.fromkeys((row["deviation"], row["grid"]) for row in estimates):
        line = [f"**{name}**" if name == "identify" else f"{name}, {grid}"]
        for samples in logs:
            row = find.get((samples, name, grid))
            line += [number(row[column]) if row else "" for column in
                     ("estimate_ms", "white_relative_error", "walk_relative_error", "white_coverage", "walk_coverage")]
        lines.append(line)
    header = [""]
    for samples in logs:
        header += [f"{log_text(samples)}: ms", "error of N", "of K", "intervals hold N", "K"]
    few = [find[samples, "oadev", "1-2-5"]["estimate_ms"] for samples in logs]
    dearer = find[logs[-1], "identify", "none"]["estimate_ms"] / few[-1]
    return ALLAN.format(costs="\n\n".join(costs), estimates=table(header, lines), short=number(few[0]),
                        long=number(few[-1]), dearer=number(dearer))


def compiling_section(rows, compiler):
    lines = [[row["what"], GROUPS.get(row["group"], ""), f"{row['order']:.0f}" if row["order"] else "",
              row["scalar"] or "", spread((row["cpu_s_min"], row["cpu_s_median"], row["cpu_s_max"])),
              f"{row['peak_MB']:.0f}"] for row in rows]
    return COMPILING.format(compiler=compiler, repetitions="two",
                            table=table(["", "group", "order", "scalar", "s", "MB"], lines))


def choices(representation, integrators):
    rows = []
    for scene in integrators.scenes:
        pick = representation.recommended(scene)
        row = [SCENES[scene], "—", "—", "—"]
        if pick:
            curve = dict(group=pick["group"], scalar="double", order=pick["order"])
            single, dense = (representation.time(way, pick["knot_interval"], **curve) for way in ("single", "dense"))
            row[1] = f"**{choice_text(pick)}, double**"
            row[2] = f"{number(single)} / {number(dense)}"
            row[3] = number(pick["bytes_per_second"] / 1000)
        rate = RATE if RATE in integrators.rates else integrators.rates[-1]
        rows.append([*row, *(integrators.cheapest(scene, "industrial", rate, schemes) or "—"
                             for schemes in (POINT_SCHEMES, INCREMENT_SCHEMES))])
    header = ["scene", "curve", "ns per sample, one by one / `sample_imu()`", "kB of curve per second",
              f"integrator for samples at {rate:g} Hz", "for increments"]
    return CHOICES.format(table=table(header, rows), gyro=number(GYRO_NOISE), accel=number(ACCEL_NOISE))


def draw_and_write(output, folder):
    """Draws the plots into the folder and writes the page, both of the csv files in the folder."""
    set_style()
    with open(folder / "machine.csv", newline="", encoding="utf-8") as file:
        machine = {row["what"]: row["value"] for row in csv.DictReader(file)}
    representation, integrators = read_representation(folder), read_integrators(folder)
    read = {name: read_csv(folder / f"{name}.csv") for name in KEPT}
    if not all((representation.scenes, integrators.scenes, *read.values())):
        sys.exit(f"study.py: {folder}: expected the csv files of a whole study")
    for column, label, noise, derivative in (("accel_rms", "specific force, RMS error [m/s²]", ACCEL_NOISE, 2),
                                             ("gyro_rms", "angular velocity, RMS error [rad/s]", GYRO_NOISE, 1)):
        draw_pareto(representation, folder, column, label, noise)
        draw_knots(representation, folder, column, label, noise, derivative)
    draw_integrators_pareto(integrators, folder)
    draw_integrators_rates(integrators, folder)
    draw_error_terms(read["error_terms"], folder)
    draw_allan(read["allan"], folder)
    compiling = read_csv(folder / "compile.csv")
    sections = [PAGE_HEAD.format(minutes=number(float(machine["seconds"]) / 60), **machine),
                choices(representation, integrators), representation_section(representation, folder, machine),
                integrators_section(integrators), error_terms_section(read["error_terms"]),
                allan_section(read["allan"])]
    if compiling:
        sections.append(compiling_section(compiling, pathlib.Path(machine["compiler"].split()[0]).name))
    (output / "speed_and_accuracy.md").write_text(reflow("\n".join(sections)), encoding="utf-8")

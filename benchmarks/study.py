#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The speed/accuracy study: measures on this machine, draws, and writes the page.

    study.py BUILD_DIR [--output docs] [--data GROUNDTRUTH] [--quick]

BUILD_DIR is that of the preset `bench`. GROUNDTRUTH is a real trajectory (TUM, or csv as EuRoC has it). Writes into the
output folder speed_and_accuracy.md and study/: csv, svg and png files. --draw-only makes plots and page again from the
csv files that are there. Needs numpy and matplotlib."""

import argparse
import csv
import datetime
import json
import os
import pathlib
import re
import shlex
import statistics
import subprocess
import sys
import tempfile
import time

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import thin_svg

PARTS = ("representation", "integrators", "error_terms", "allan")
SCENES = {"hand_held": "hand-held", "drone": "drone", "wheeled_robot": "wheeled robot", "measured": "measured flight"}
GROUPS = {"SO3xR3": "SO(3) × R³", "SE3": "SE(3)"}
ORDERS = range(3, 9)

# A sample's noise of a good MEMS IMU: the densities of the ADIS16448's data sheet (presets::adis16448) at 200 Hz, the
# length of three axes. What a curve is off by should not be seen beside it.
RATE = 200
GYRO_NOISE = float(np.sqrt(3 * RATE) * 0.66 * np.pi / 180 / 60)
ACCEL_NOISE = float(np.sqrt(3 * RATE) * 0.11 / 60)
SHARE = 0.1

# Okabe and Ito's colours, which colour-blind people tell apart.
BLACK, ORANGE, SKY, GREEN, BLUE, RED, PINK = "#000000 #E69F00 #56B4E9 #009E73 #0072B2 #D55E00 #CC79A7".split()
STAR = {"color": "white", "markeredgecolor": BLACK}


# ---------------------------------------------------------------------------------------------------- measuring

def say(text):
    print(text, file=sys.stderr, flush=True)


def measure_parts(build, folder, arguments):
    """Runs the parts of the study; returns how long each took, s."""
    took = {}
    for part in PARTS:
        command = [str(build / "benchmarks" / "study"), "--part", part, "--output", str(folder),
                   "--repetitions", str(arguments.repetitions)]
        command += ["--data", str(arguments.data)] if arguments.data and part == "representation" else []
        command += ["--quick"] if arguments.quick else []
        start = time.monotonic()
        (folder / f"{part}.csv").unlink(missing_ok=True)
        if subprocess.run(command).returncode != 0:
            sys.exit(f"study.py: part {part} failed")
        took[part] = time.monotonic() - start
    return took


def count_instructions(build, folder):
    """Instructions a sample, by valgrind, into instructions.csv: not there where they cannot be counted."""
    program = build / "benchmarks" / "study_instructions"
    path = folder / "instructions.csv"
    path.unlink(missing_ok=True)
    if not program.exists():
        return
    say("counting instructions")
    output = subprocess.run([program, "--csv", "--instructions", "--calls", "1000"], stdout=subprocess.PIPE, text=True,
                            check=True).stdout
    rows = [re.fullmatch(r"(\w+)_(float|double)_(\d)_(single|dense)_instructions,([\d.]+),instructions", line)
            for line in output.splitlines()]
    rows = [row.groups() for row in rows if row]
    if rows:
        write_csv(path, ("group", "scalar", "order", "way", "instructions"), rows)


INCLUDES = "#include <splinertia/group/pose.hpp>\n#include <splinertia/spline/spline.hpp>\n"
CURVE = INCLUDES + """#include <splinertia/imu/ideal_imu.hpp>
using namespace splinertia;
using Curve = Spline<{group}, {order}>;
auto imu(std::vector<Curve::Group> points, double t) {{
  const Curve curve({{.start = 0.0, .interval = 0.1}}, std::move(points));
  return ideal_imu(curve.evaluate<2>(t));
}}
"""
DENSE = INCLUDES + """#include <splinertia/imu/sample_imu.hpp>
using namespace splinertia;
using Curve = Spline<{group}, {order}>;
auto imu(std::vector<Curve::Group> points) {{
  const Curve curve({{.start = 0.0, .interval = 0.1}}, std::move(points));
  return sample_imu(curve, curve.start(), 1e-3, 1000);
}}
"""
FIT = INCLUDES + """#include <splinertia/spline/fit/fit.hpp>
using namespace splinertia;
using Curve = Spline<{group}, {order}>;
auto through(const std::vector<Stamped<Curve::Group, double>>& poses) {{
  return fit<Curve>(poses, {{.knot_interval = 0.1}});
}}
"""


def compile_cases(quick):
    """(group, order, scalar, what) and the program."""
    kept = {"SO3xR3": "SO3xR3<{}>", "SE3": "Sophus::SE3<{}>"}
    cases = [(("", "", "", "the two headers alone"), INCLUDES)]
    for group, name in kept.items():
        for order in ORDERS:
            if quick and order != 4:
                continue
            cases.append(((group, order, "double", "evaluate"), CURVE.format(group=name.format("double"), order=order)))
    for scalar in ("float", "long double"):
        cases.append((("SO3xR3", 4, scalar, "evaluate"), CURVE.format(group=kept["SO3xR3"].format(scalar), order=4)))
    for group, name in kept.items():
        of = {"group": name.format("double"), "order": 4}
        cases.append(((group, 4, "double", "sample_imu"), DENSE.format(**of)))
        cases.append(((group, 4, "double", "fit"), FIT.format(**of)))
    return cases


def compiler_of(build):
    """The command that compiles study.cpp, in words, without what it is about."""
    with open(build / "compile_commands.json") as file:
        entries = [entry for entry in json.load(file) if entry["file"].endswith("benchmarks/study.cpp")]
    if not entries:
        sys.exit(f"study.py: {build} has no study: it takes a folder that was built with the preset bench")
    words = shlex.split(entries[0]["command"])
    return words[:words.index("-o")]


def measure_compiling(build, folder, arguments):
    """CPU time and peak memory of compiling small programs, into compile.csv."""
    words = compiler_of(build)
    keep = [words[0]]
    for i, word in enumerate(words):
        if word.startswith(("-I", "-D", "-std=")):
            keep.append(word)
        elif word == "-isystem":
            keep += words[i:i + 2]
    cases = compile_cases(arguments.quick)
    repetitions = 1 if arguments.quick else 2
    seconds, memory = [[] for _ in cases], [0] * len(cases)
    with tempfile.TemporaryDirectory() as place:
        for repetition in range(repetitions):
            say(f"compiling, {repetition + 1} of {repetitions}")
            for i, (case, text) in enumerate(cases):
                source = pathlib.Path(place) / "program.cpp"
                source.write_text(text)
                process = subprocess.Popen(keep + ["-O2", "-c", str(source), "-o", os.devnull])
                _, status, usage = os.wait4(process.pid, 0)
                process.returncode = os.waitstatus_to_exitcode(status)
                if process.returncode != 0:
                    sys.exit(f"study.py: this does not compile:\n{text}")
                seconds[i].append(usage.ru_utime + usage.ru_stime)
                memory[i] = max(memory[i], usage.ru_maxrss * 1024 / 1e6)
    columns = ("group", "order", "scalar", "what", "cpu_s_min", "cpu_s_median", "cpu_s_max", "peak_MB")
    write_csv(folder / "compile.csv", columns,
              [(*case, f"{min(s):.2f}", f"{statistics.median(s):.2f}", f"{max(s):.2f}", f"{m:.0f}")
               for (case, _), s, m in zip(cases, seconds, memory)])


def caches():
    """The caches of the first core: "L1d 48 KiB, …"."""
    found = []
    for index in sorted(pathlib.Path("/sys/devices/system/cpu/cpu0/cache").glob("index*")):
        level, kind, size = ((index / name).read_text().strip() for name in ("level", "type", "size"))
        size = int(size.rstrip("K"))
        size = f"{size} KiB" if size < 1024 else f"{size / 1024:g} MiB"
        found.append(f"L{level}{'' if kind == 'Unified' else kind[0].lower()} {size}")
    return ", ".join(found)


def describe_machine(build, folder, took, arguments):
    model = "unknown"
    if os.path.exists("/proc/cpuinfo"):
        lines = open("/proc/cpuinfo").read().splitlines()
        fields = dict(line.split(":", 1) for line in reversed(lines) if ":" in line)
        fields = {key.strip(): value.strip() for key, value in fields.items()}
        model = f"{fields.get('model name', model)}, family {fields.get('cpu family')}, model {fields.get('model')}"
        vectors = [name for flag, name in (("avx512f", "AVX-512"), ("avx2", "AVX2")) if flag in fields.get("flags", "")]
        model += "".join(f", {name}" for name in vectors[:1])
    words = compiler_of(build)
    version = subprocess.run([words[0], "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout
    version = version.splitlines()[0]
    flags = [word for word in dict.fromkeys(words) if word.startswith(("-O", "-m", "-std", "-f", "-DNDEBUG"))]
    write_csv(folder / "machine.csv", ("what", "value"), [
        ("processor", model), ("cores", os.cpu_count()), ("caches", caches()), ("compiler", version),
        ("flags", " ".join(flags)), ("date", datetime.date.today().isoformat()), ("repetitions", arguments.repetitions),
        ("load_before", f"{arguments.load:.1f}"), ("seconds", f"{sum(took.values()):.0f}"),
        ("parts", "; ".join(f"{part} {seconds:.0f} s" for part, seconds in took.items())),
        ("data", f"`{arguments.data.name}`" if arguments.data else ""), ("quick", int(arguments.quick))])


# ---------------------------------------------------------------------------------------------------- tables

def write_csv(path, columns, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(rows)


def read_csv(path):
    """Rows as dictionaries, numbers as such, empty cells as None; no rows where there is no file."""
    def value(text):
        try:
            return float(text) if text else None
        except ValueError:
            return text
    if not path.exists():
        return []
    with open(path, newline="") as file:
        return [{key: value(text) for key, text in row.items()} for row in csv.DictReader(file)]


def number(x, digits=2):
    """So many digits that count, without exponents where that is readable."""
    if x is None:
        return ""
    if x == 0:
        return "0"
    magnitude = int(f"{x:.{digits - 1}e}".split("e")[1])  # of what is left when it is rounded
    if -4 <= magnitude < 6:
        decimals = max(0, digits - 1 - magnitude)
        return f"{round(x, digits - 1 - magnitude):.{decimals}f}"
    mantissa, exponent = f"{x:.{digits - 1}e}".split("e")
    return f"{mantissa}e{int(exponent)}"


def table(header, rows):
    lines = ["| " + " | ".join(str(cell) for cell in row) + " |" for row in [header, ["---"] * len(header), *rows]]
    return "\n".join(lines)


def seconds_text(interval):
    return f"{interval:g}"


class Representation:
    """The rows of representation.csv, and what follows from them."""

    def __init__(self, rows):
        self.rows = rows
        self.scenes = [scene for scene in SCENES if any(row["scene"] == scene for row in rows)]
        self.intervals = sorted({row["knot_interval"] for row in rows}, reverse=True)

    def find(self, **wanted):
        return [row for row in self.rows if all(row[key] == value for key, value in wanted.items())]

    def one(self, **wanted):
        return self.find(**wanted)[0]

    def times(self, way, **wanted):
        """Smallest, middle and largest ns a sample over all curves of a kind: knots hardly matter."""
        rows = self.find(**wanted)
        return (min(row[f"{way}_ns_min"] for row in rows), statistics.median(row[f"{way}_ns_median"] for row in rows),
                max(row[f"{way}_ns_max"] for row in rows))

    @staticmethod
    def good_enough(row):
        return row["accel_rms"] <= SHARE * ACCEL_NOISE and row["gyro_rms"] <= SHARE * GYRO_NOISE

    def recommended(self, scene):
        """Of the curves in double that are good enough, those with the longest knots, of them the cheapest. None for a
        measured motion: what takes the place of the truth is a spline itself, and shows how alike two splines are."""
        rows = [row for row in self.find(scene=scene, scalar="double") if self.good_enough(row) and row["order"] >= 4]
        if not rows or scene == "measured":
            return None
        longest = max(row["knot_interval"] for row in rows)
        return min((row for row in rows if row["knot_interval"] == longest),
                   key=lambda row: self.times("dense", group=row["group"], order=row["order"], scalar="double")[0])


def choice_text(row):
    return f"{GROUPS[row['group']]}, order {row['order']:.0f}, knots {seconds_text(row['knot_interval'])} s"


# ---------------------------------------------------------------------------------------------------- plots

def set_style():
    plt.rcParams.update({"font.size": 9, "axes.titlesize": 10, "svg.hashsalt": "splinertia", "axes.grid": True,
                         "grid.alpha": 0.25, "lines.linewidth": 1.2, "legend.fontsize": 8,
                         "savefig.facecolor": "white"})


def save(figure, folder, name):
    for form in ("svg", "png"):
        thin_svg.save(figure, folder / f"{name}.{form}")
    plt.close(figure)


def front(points):
    """The points (x, y, …) that none other is better than in both."""
    best, result = np.inf, []
    for point in sorted(points, key=lambda p: (p[0], p[1])):
        if point[1] < best:
            best = point[1]
            result.append(point)
    return result


def panels(count, height=3.6):
    columns = 2 if count in (2, 4) else count
    rows = -(-count // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(9.5, height * rows), layout="constrained", squeeze=False)
    return figure, list(axes.flat)


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
                    x = data.times("dense", group=group, scalar=scalar, order=order, knot_interval=interval)[0]
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
            x = data.times("dense", group=pick["group"], scalar="double", order=pick["order"],
                           knot_interval=pick["knot_interval"])[0]
            axis.plot(x, pick[column], "*", markersize=15, zorder=4, **STAR)
            axis.set_title(f"{SCENES[scene]}\n★ {choice_text(pick)}", fontsize=9)
    for axis in axes:
        axis.xaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
        axis.xaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda x, _: f"{x:g}"))
        axis.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
        axis.set_xlabel("ns a sample of sample_imu()")
    for axis in axes[::2]:
        axis.set_ylabel(label)
    handles = [plt.Line2D([], [], color=colours[i], label=f"knots {seconds_text(i)} s apart") for i in intervals]
    handles += [plt.Line2D([], [], color="0.3", linestyle="none", marker=marker, markersize=5,
                           markerfacecolor="0.3" if filled else "white", label=f"{GROUPS[group]}, {scalar}")
                for (group, scalar), (marker, filled) in looks.items()]
    handles += [plt.Line2D([], [], color=BLACK, linestyle=":", label="a tenth of the IMU's noise"),
                plt.Line2D([], [], marker="*", markersize=12, label="recommended", **STAR)]
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


POINT_SCHEMES = {"Euler": PINK, "ZeroOrderHold": ORANGE, "Midpoint": GREEN, "Trapezoid": SKY, "RungeKutta4": BLUE,
                 "RungeKutta4DoubleStep": "0.55", "Magnus4": RED}
INCREMENT_SCHEMES = {"UncorrectedIncrements": PINK, "RotationCorrectedIncrements": ORANGE,
                     "TwoSampleIncrements": BLUE, "ThreeSampleIncrements": RED}
GRADES = {"consumer": (0, (1, 1)), "industrial": (0, (4, 1.5, 1, 1.5)), "tactical": (0, (5, 2))}  # and their lines


class Integrators:
    def __init__(self, rows):
        self.rows = rows
        self.scenes = [scene for scene in SCENES if any(row["scene"] == scene for row in rows)]
        self.rates = sorted({row["rate"] for row in rows})
        self.error = {(row["scene"], row["grade"], row["rate"], row["scheme"]): row["position_rms"] for row in rows}
        self.schemes = [s for s in (*POINT_SCHEMES, *INCREMENT_SCHEMES) if any(row["scheme"] == s for row in rows)]

    def times(self, scheme):
        """Of a sample, over all scenes and rates: what a scheme costs depends on neither."""
        rows = [row for row in self.rows if row["scheme"] == scheme]
        return (min(row["ns_min"] for row in rows), statistics.median(row["ns_median"] for row in rows),
                max(row["ns_max"] for row in rows))

    def floor(self, scene, grade, rate):
        """What noise alone does: the error of the scheme that adds least to it."""
        return min(self.error[scene, grade, rate, scheme] for scheme in self.schemes)

    def cheapest(self, scene, grade, rate, schemes):
        """The cheapest scheme whose own error is below a tenth of the noise's."""
        good = [s for s in schemes if s in self.schemes
                and self.error[scene, "none", rate, s] <= SHARE * self.floor(scene, grade, rate)]
        return min(good, key=lambda s: self.times(s)[0], default=None)


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
            colour = {**POINT_SCHEMES, **INCREMENT_SCHEMES}[scheme]
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
        axis.set(xscale="log", yscale="log", xlabel=f"ns a sample")
        axis.set_title(SCENES[scene] + (f"\n★ {pick}" if pick else ""), fontsize=9)
        if pick:
            axis.plot(data.times(pick)[0], data.error[scene, "none", rate, pick], "*", markersize=17, color="none",
                      markeredgecolor=BLACK, zorder=4)
        axis.xaxis.set_major_locator(matplotlib.ticker.LogLocator(subs=(1, 2, 5)))
        axis.xaxis.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda x, _: f"{x:g}"))
        axis.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    axes[0].set_ylabel(f"position error over 10 s at {rate:g} Hz, RMS [m]")
    handles = [plt.Line2D([], [], color=colour, linestyle="none", marker=marker, label=scheme)
               for schemes, marker in ((POINT_SCHEMES, "o"), (INCREMENT_SCHEMES, "D"))
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
            colour = {**POINT_SCHEMES, **INCREMENT_SCHEMES}[scheme]
            axis.plot(data.rates, [data.error[scene, "none", rate, scheme] for rate in data.rates],
                      "-o" if scheme in POINT_SCHEMES else "--D", color=colour, markersize=3)
        for grade, line in GRADES.items():
            axis.plot(data.rates, [data.floor(scene, grade, rate) for rate in data.rates], color=BLACK, linestyle=line,
                      linewidth=1.3, zorder=4)
        pick = data.cheapest(scene, "industrial", RATE if RATE in data.rates else data.rates[-1], POINT_SCHEMES)
        axis.set(xscale="log", yscale="log", xlabel="rate [Hz]")
        axis.set_title(SCENES[scene] + (f"\n★ {pick}" if pick else ""), fontsize=9)
        axis.set_xticks(data.rates, [f"{rate:g}" for rate in data.rates], fontsize=7.5)
        axis.xaxis.set_minor_locator(matplotlib.ticker.NullLocator())
    axes[0].set_ylabel("position error over 10 s, RMS [m]")
    handles = [plt.Line2D([], [], color=colour, linestyle=line, marker=marker, markersize=4, label=scheme)
               for schemes, line, marker in ((POINT_SCHEMES, "-", "o"), (INCREMENT_SCHEMES, "--", "D"))
               for scheme, colour in schemes.items() if scheme in data.schemes]
    handles += [plt.Line2D([], [], color=BLACK, linestyle=line, linewidth=1.3, label=f"noise alone, {grade}")
                for grade, line in GRADES.items()]
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    save(figure, folder, "integrators_rates")


def draw_error_terms(rows, folder):
    rows = [row for row in rows if row["model"] != "ErrorModel{}"]
    rows = sorted(rows, key=lambda row: row["extra_ns_median"])
    y = np.arange(len(rows))
    least = 0.03  # ns: below is what cannot be told from nothing
    middle = np.array([max(row["extra_ns_median"], least) for row in rows])
    low = np.array([max(row["extra_ns_min"], least) for row in rows])
    high = np.array([max(row["extra_ns_max"], least) for row in rows])
    figure, axis = plt.subplots(figsize=(9, 7.2), layout="constrained")
    colours = [BLUE if re.fullmatch(r"\w+", row["model"]) else ORANGE for row in rows]
    axis.barh(y, middle - least, left=least, color=colours, height=0.65, alpha=0.85)
    axis.errorbar(middle, y, xerr=[np.maximum(middle - low, 0), np.maximum(high - middle, 0)], fmt="none", ecolor="0.25",
                  elinewidth=0.9)
    for at, row in zip(y, rows):
        axis.annotate(number(row["extra_ns_median"]) if row["extra_ns_median"] > least else "0",
                      (max(row["extra_ns_max"], least), at), textcoords="offset points", xytext=(4, -3), fontsize=7.5)
    axis.set(xscale="log", xlim=(least, 3 * high.max()), ylim=(-0.7, len(rows) - 0.3),
             xlabel="ns a sample of both sensors, beyond the empty model: median, smallest and largest")
    axis.set_yticks(y, [row["model"] for row in rows])
    axis.grid(axis="y", visible=False)
    axis.legend(handles=[plt.Rectangle((0, 0), 1, 1, color=BLUE, label="one term"),
                         plt.Rectangle((0, 0), 1, 1, color=ORANGE, label="models that are used")], loc="lower right")
    save(figure, folder, "error_terms")


def log_text(samples):
    return f"log of {samples:,.0f} samples".replace(",", " ")


def draw_allan(rows, folder):
    """Error of N and of K against the time of an estimate."""
    rows = [row for row in rows if row["white_relative_error"] is not None]
    logs = sorted({row["samples"] for row in rows})
    figure, axes = plt.subplots(len(logs), 2, figsize=(9.5, 3.4 * len(logs)), layout="constrained", squeeze=False)
    names = list(dict.fromkeys(row["deviation"] for row in rows))
    grids = list(dict.fromkeys(row["grid"] for row in rows))
    colours = dict(zip(names, (BLUE, ORANGE, GREEN, RED, PINK, SKY, BLACK, "0.5")))
    markers = dict(zip(grids, "o^sDvP*X"))
    for line, samples in zip(axes, logs):
        for axis, column, name in zip(line, ("white_relative_error", "walk_relative_error"), ("N", "K")):
            some = [row for row in rows if row["samples"] == samples and row[column]]
            for row in some:
                axis.plot(row["ns_min"], row[column], markers[row["grid"]], color=colours[row["deviation"]], markersize=6)
            best = front([(row["ns_min"], row[column]) for row in some])
            axis.plot([p[0] for p in best], [p[1] for p in best], color="0.5", linewidth=0.9, zorder=0)
            axis.set(xscale="log", ylim=(0, 1.08 * max((row[column] for row in some), default=1)),
                     title=f"{log_text(samples)}", xlabel="ns a sample", ylabel=f"relative error of {name}, RMS")
    handles = [plt.Line2D([], [], color=colour, linestyle="none", marker="o", label=name)
               for name, colour in colours.items()]
    handles += [plt.Line2D([], [], color="0.4", linestyle="none", marker=marker, label=f"averaging times: {grid}")
                for grid, marker in markers.items() if grid != "none"]
    figure.legend(handles=handles, loc="outside lower center", ncols=4)
    save(figure, folder, "allan")


# ---------------------------------------------------------------------------------------------------- the page

PAGE_HEAD = """# Speed and accuracy: what to choose

This page measures every choice that trades accuracy for speed, on one machine. [In short](#in-short) has the
recommendations. A program makes the whole page with its tables and plots:

    cmake --workflow --preset bench
    benchmarks/study.py build/bench --data GROUNDTRUTH      # needs numpy and matplotlib

It took {minutes} minutes ({parts}).
The numbers behind the plots are in [study/](study/).

| | |
|---|---|
| processor | {processor}; one of {cores} cores used; {caches} |
| compiler | {compiler}, `{flags}` |
| measured | {date}, load {load_before} at the beginning, on a shared machine |

Times are CPU time. Every kernel is measured {repetitions} times for some milliseconds, alternating with those that it is compared
with. Tables have the smallest time and, in brackets, the median and the largest. Compare the smallest, because the
machine is shared. Errors are exactly reproducible with the same compiler.
"""

CHOICES = """## In short

{table}

These are the cheapest choices that are good enough. Good enough means that the error is negligible beside the noise of
an industrial-grade MEMS IMU (ADIS16448: {gyro} rad/s and {accel} m/s² in a sample of three axes at 200 Hz). For curves
the limit is a tenth of this noise, in RMS, and the knots are as far apart as it allows. For integrators the limit is a
tenth of the position error over 10 s that the noise causes.

The wheeled robot of this study carries an IMU and is shaken by the floor, so it needs a pose in space. For planar
motion without an IMU use `SE2`, which this study does not measure ([which group](splines.md#which-group)).
"""

REPRESENTATION = """## Curves: group, order, knots, scalar

The scenes are sums of sines. [scenes.hpp](../benchmarks/study/scenes.hpp) has their amplitudes and frequencies.

| scene | what it is |
|---|---|
| hand-held | swings of 0.3 to 1.7 Hz, up to 3 rad/s; tremor at 8 to 9 Hz, 0.1 mm and 1 mrad |
| drone | turns at 0.4 to 1.6 Hz, several g, up to 10 rad/s; corrections at 4 Hz, shaking at 13 to 15 Hz, 0.05 mm and 3 mrad |
| wheeled robot | an eight of 12 m × 6 m in 25 s; the floor at 2 Hz, 2 mm, and at 11 to 13 Hz, 0.02 mm and 0.3 mrad |
{measured}
A curve is fitted to exact poses of the scene with `fit()` in double, at 100 Hz or five poses per knot interval,
whichever is more. 12.5 s of it are compared with the scene. Since the poses are exact, the error is what the curve
cannot follow.

![Error of the specific force against time a sample](study/representation_pareto_accel.svg)

![Error of the angular velocity against time a sample](study/representation_pareto_gyro.svg)

Each line is the Pareto front of the curves with the same knots. The figures are orders, for SO(3) × R³ in double.

![Error of the specific force against knot interval](study/representation_knots_accel.svg)

![Error of the angular velocity against knot interval](study/representation_knots_gyro.svg)

### Knots come first

The smallest order for which f and ω are good enough, in double on {group}, for each knot interval (— is none):

{orders}

- **Knots must be closer than half a period of the fastest relevant motion.** With knots further apart all orders are
  equally wrong, because faster oscillations are smoothed away. Tremor of 9 Hz needs knots well below 0.05 s.
- **Below that, each halving of the interval divides the error of f by 2 to the power of order − 2,** and that of ω by 2
  to the power of order − 1. For f that is 4 for the cubic and 16 for order 6. So higher orders pay off once knots are
  close enough. Rotations about changing axes gain less from order 6 on, because they do not commute (hand-held, order
  8, last halving: ω by {last_halving} instead of 128).
- **Order 4 is the minimum for an accelerometer.** With order 3 the acceleration jumps, and the table below shows the
  error.
- **Close knots are cheap to evaluate but costly otherwise.** Halving the interval doubles the memory and the time of a
  fit. Knots closer than two or three poses of your data follow their noise. Each higher order costs {per_order}, and no memory.
- A curve fitted to a measured trajectory has lost everything above half the rate of the knots, whatever its order.

### What it costs

The table has ns per IMU sample over all scenes and knots (1 kHz for `sample_imu()`), instructions counted with AVX2
(-march=x86-64-v3), and the time of `g++ -O2 -c` for ten lines that evaluate one sample:

{cost}

### SO(3) × R³ or SE(3)

Use SO(3) × R³ unless you need a property of SE(3). The table has the errors in double, RMS (largest), with the
recommended knots of each scene; for the measured flight these are 0.0125 s:

{errors}

- **The angular velocity is identical,** because both represent rotations in the same way.
- **SE(3) has a larger error of f:** at order 6 by the factors
  {ratios}. It takes {time_ratio} times as long one by one. Its acceleration contains the angular velocity. If a
  body turns fast and independently of its path, this only adds error.
- Use SE(3) if the curve must be the same for every point of the body that the pose may refer to
  ([splines](splines.md)).

### float, double or long double

Use double. The table has the RMS error of f [m/s²] for order 6 on SO(3) × R³ and the wheeled robot, which is up to 7 m
from the origin; knots in s:

{scalars}

- **float is sufficient for knots down to 0.025 s** within some metres of the origin. The rounding of a position is
  divided by the interval squared, which is about 6e-8·|p|/interval² in f. With closer knots, or far from the origin,
  this error grows.
- float takes {float_single} of the time of double one by one, and {float_dense} in `sample_imu()`.
- **long double gains nothing here.** The control points were fitted in double, so more digits in the evaluation change
  nothing visible. It takes {long_single} times as long one by one, and {long_dense} times in `sample_imu()`, since no vector
  unit supports it. Use it for checks.
"""

INTEGRATORS = """## Integrators

Use `Midpoint` for slow motion or high rates, `RungeKutta4DoubleStep` for fast motion at low rates, and
`TwoSampleIncrements` if the IMU delivers increments.

The error is the RMS position error over 10 s from the true initial state. Without noise it is the scheme's own error;
with noise all good schemes are equally wrong. There are 20 runs of each grade:
{grades}.

![Error against time a sample](study/integrators_pareto.svg)

![Error against rate](study/integrators_rates.svg)

The next table has the cheapest scheme whose own error is at most a tenth of the error that the noise of that grade
causes. The first name is for point samples, the one in brackets for increments, which an IMU delivers if it integrates
internally. A better scheme gains nothing; — means that no scheme is good enough.

{cheapest}

The cost of each scheme, and its own error at {rate:g} Hz:

{cost}

- **Euler saves {euler_saves} ns per sample over the midpoint rule, but its error is {euler_worse} times as large** at {rate:g} Hz. The
  zero-order hold saves nothing.
- **`{fourth}` is the order-4 scheme to use for point samples.** It spans two intervals at once.
  `RungeKutta4` on single intervals must interpolate between samples and stays at order 2.
- **An IMU with increments is an advantage.** `TwoSampleIncrements` is more accurate than every scheme on point samples,
  and as cheap as the midpoint rule.
- **A better scheme is cheaper than a higher rate.** Twice the rate means twice the samples, and divides the error of
  the midpoint rule by 4.
- By its data sheet the consumer part has less white noise than the industrial one. The advantage of the industrial part
  is its bias, which is left out here because an estimator removes it.
"""

ERROR_TERMS = """## Error terms

The table has ns per sample of both sensors beyond the empty model, which takes {empty}. Each term is on all axes of both
sensors unless the table says otherwise.

![Time of error terms](study/error_terms.svg)

{table}

- **Biases, scale factor, rate ramp and g-sensitivity are free;** misalignment and saturation are almost free. Noise
  dominates the cost: six normal numbers take about {white} ns.
- **Terms with a function or many random numbers are expensive:** sinusoidal vibration (a reproducible sine per axis),
  bias instability (7 normal numbers per axis), the temperature terms (an exponential per sensor). If the log is short,
  leave out bias instability, or use Gauss–Markov.
"""

ALLAN = """## Allan deviations

For N and K use the overlapping deviation on octaves or 1-2-5; use `identify()` to find which terms exist.

The logs last an hour and contain white noise and a random walk, at 200 Hz and as averages over 4 s. The next two tables
have the time for a whole curve, ns per sample, smallest:

{costs}

Accuracy of the estimates of N (white noise) and K (random walk) from simulated logs, by `fit_curve()` from such a curve
and by `identify()` from the log itself. Errors are relative, RMS. The fraction of one-sigma intervals that contain the
truth should be 0.68.

![Error of N and K against time](study/allan.svg)

{estimates}

- **The overlapping deviation on octaves or 1-2-5 is enough for N and K,** in {short} to {long} ms. The non-overlapping
  deviation is no cheaper on a long log.
- **More averaging times make the estimates worse, not better:** neighbouring points carry the same information, and the
  fit counts it twice.
- **`identify()` takes {dearer} times as long** as 1-2-5 on a long log, with the same accuracy. Only it finds which of the
  terms exist ([allan.md](allan.md)).
- The modified deviation costs three to four times as much on a long log.
"""

COMPILING = """## What it costs to compile

`{compiler} -O2 -c`, CPU seconds of {repetitions} runs: smallest (median, largest), and peak memory:

{table}
"""


def spread(values, digits=2):
    smallest, middle, largest = values
    return f"{number(smallest, digits)} ({number(middle, digits)}, {number(largest, digits)})"


def representation_section(data, folder, measured_file):
    measured = (f"| measured flight | {measured_file}: a curve of order 6 with knots 0.02 s apart, fitted to it |\n"
                if "measured" in data.scenes else "")
    rows = []
    for scene in data.scenes:
        row = [SCENES[scene]]
        for interval in data.intervals:
            pick = min((r["order"] for r in data.find(scene=scene, group="SO3xR3", scalar="double", knot_interval=interval)
                        if data.good_enough(r)), default=None)
            row.append("—" if pick is None else f"{pick:.0f}")
        rows.append(row)
    orders = table(["knots, s", *map(seconds_text, data.intervals)], rows)

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
    cost = table(["", "order", "one by one, ns", "`sample_imu()`, ns", "instructions", "`sample_imu()`, instructions",
                  "compiling, s"], rows)

    rows, ratios = [], {}
    for scene in data.scenes:
        pick = data.recommended(scene)
        interval = pick["knot_interval"] if pick else min(data.intervals, key=lambda i: abs(i - 0.0125))
        for order in ORDERS:
            split, rigid = (data.one(scene=scene, group=g, scalar="double", order=order, knot_interval=interval)
                            for g in ("SO3xR3", "SE3"))
            if order == 6:
                ratios[scene] = rigid["accel_rms"] / split["accel_rms"]
            both = [f"{number(split[f'{what}_rms'])} ({number(split[f'{what}_max'])})"
                    for what in ("orientation", "position", "gyro", "accel")]
            rows.append([f"{SCENES[scene]}, {seconds_text(interval)} s" if order == 3 else "", order, *both,
                         f"{number(rigid['position_rms'])} ({number(rigid['position_max'])})",
                         f"{number(rigid['accel_rms'])} ({number(rigid['accel_max'])})"])
    errors = table(["scene, knots", "order", "orientation, rad", "position, m", "ω, rad/s", "f, m/s²", "SE(3): position, m",
                    "f, m/s²"], rows)

    scene = "wheeled_robot" if "wheeled_robot" in data.scenes else data.scenes[0]
    rows = [[scalar, *(number(data.one(scene=scene, group="SO3xR3", scalar=scalar, order=6, knot_interval=i)["accel_rms"])
                       for i in data.intervals)] for scalar in ("float", "double", "long double")]
    scalars = table(["", *map(seconds_text, data.intervals)], rows)

    def ratio(way, group="SO3xR3", over=None, scalar="double"):
        """Of times, the range over the orders."""
        ratios = [data.times(way, group=group, order=order, scalar=scalar)[0]
                  / data.times(way, group="SO3xR3", order=order, scalar="double")[0] for order in ORDERS]
        low, high = number(min(ratios)), number(max(ratios))
        return low if low == high else f"{low} to {high}"

    # Of a cubic in float with knots at whole numbers of samples, against knots that are far apart.
    slow = max((data.times("dense", group="SO3xR3", scalar="float", order=4, knot_interval=i)[0], i) for i in data.intervals
               if i in (0.1, 0.05))
    fast = min(data.times("dense", group="SO3xR3", scalar="float", order=4, knot_interval=i)[0] for i in data.intervals)
    subnormal = "" if slow[0] < 2 * fast else (
        f" Where samples\n  fall on knots but for rounding, powers of what is left are subnormal numbers in float, which take the "
        f"processor\n  long: order 4 with knots {slow[1]:g} s apart takes {number(slow[0])} ns instead of {number(fast)}. Setting "
        "the processor to flush them to\n  zero helps, and so does a start of the samples between knots.")
    last = sorted(data.find(scene=data.scenes[0], group="SO3xR3", scalar="double", order=8),
                  key=lambda row: -row["knot_interval"])
    per_order = [data.times(way, group="SO3xR3", scalar="double", order=8)[0]
                 - data.times(way, group="SO3xR3", scalar="double", order=3)[0] for way in ("single", "dense")]
    return REPRESENTATION.format(
        group=GROUPS["SO3xR3"], orders=orders, cost=cost, errors=errors, scalars=scalars,
        per_order=f"about {number(per_order[0] / 5)} ns per\n  sample ({number(per_order[1] / 5)} in `sample_imu()`)",
        subnormal=subnormal, measured=measured, last_halving=number(last[-2]["gyro_rms"] / last[-1]["gyro_rms"]),
        ratios=", ".join(f"{number(ratio)} ({SCENES[scene]})" for scene, ratio in ratios.items()), time_ratio=ratio("single", group="SE3"),
        float_single=ratio("single", scalar="float"), float_dense=ratio("dense", scalar="float"),
        long_single=ratio("single", scalar="long double"), long_dense=ratio("dense", scalar="long double"))


def integrators_section(data):
    rows = []
    for scene in data.scenes:
        for grade in GRADES:
            row = [f"{SCENES[scene]}, {grade}"]
            for rate in data.rates:
                names = [data.cheapest(scene, grade, rate, schemes) or "—" for schemes in (POINT_SCHEMES, INCREMENT_SCHEMES)]
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
    lines = [[row["what"], GROUPS.get(row["group"], ""), f"{row['order']:.0f}" if row["order"] else "", row["scalar"] or "",
              spread((row["cpu_s_min"], row["cpu_s_median"], row["cpu_s_max"])), f"{row['peak_MB']:.0f}"] for row in rows]
    return COMPILING.format(compiler=compiler, repetitions="two",
                            table=table(["", "group", "order", "scalar", "s", "MB"], lines))


def choices(representation, integrators):
    rows = []
    for scene in integrators.scenes:
        pick = representation.recommended(scene)
        row = [SCENES[scene], "—", "—", "—"]
        if pick:
            seen = dict(group=pick["group"], scalar="double", order=pick["order"], knot_interval=pick["knot_interval"])
            row[1] = f"**{choice_text(pick)}, double**"
            row[2] = f"{number(representation.times('single', **seen)[0])} / {number(representation.times('dense', **seen)[0])}"
            row[3] = number(pick["bytes_per_second"] / 1000)
        rate = RATE if RATE in integrators.rates else integrators.rates[-1]
        rows.append([*row, *(integrators.cheapest(scene, "industrial", rate, schemes) or "—"
                             for schemes in (POINT_SCHEMES, INCREMENT_SCHEMES))])
    header = ["scene", "curve", "ns per sample, one by one / `sample_imu()`", "kB of curve per second",
              f"integrator for samples at {rate:g} Hz", "for increments"]
    return CHOICES.format(table=table(header, rows), gyro=number(GYRO_NOISE), accel=number(ACCEL_NOISE))


def draw_and_write(output, folder):
    set_style()
    machine = {row["what"]: row["value"] for row in csv.DictReader(open(folder / "machine.csv", newline=""))}
    read = {part: read_csv(folder / f"{part}.csv") for part in PARTS}
    for part, rows in read.items():
        if not rows:
            sys.exit(f"study.py: {folder / part}.csv is not there")
    representation, integrators = Representation(read["representation"]), Integrators(read["integrators"])
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
                choices(representation, integrators), representation_section(representation, folder, machine["data"]),
                integrators_section(integrators), error_terms_section(read["error_terms"]), allan_section(read["allan"])]
    if compiling:
        sections.append(compiling_section(compiling, pathlib.Path(machine["compiler"].split()[0]).name))
    (output / "speed_and_accuracy.md").write_text("\n".join(sections))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path, metavar="BUILD_DIR")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("docs"))
    parser.add_argument("--data", type=pathlib.Path, help="a real trajectory: TUM, or csv as EuRoC has it")
    parser.add_argument("--repetitions", type=int, default=5, help="of every time")
    parser.add_argument("--quick", action="store_true", help="to see that it works; numbers are no good")
    parser.add_argument("--draw-only", action="store_true", help="plots and page of the csv files that are there")
    arguments = parser.parse_args()
    folder = arguments.output / "study"
    folder.mkdir(parents=True, exist_ok=True)
    if not arguments.draw_only:
        if arguments.data and not arguments.data.exists():
            parser.error(f"{arguments.data}: there is no such file")
        if not (arguments.build / "benchmarks" / "study").exists():
            parser.error(f"{arguments.build}: there is no benchmarks/study in it; build the preset bench")
        arguments.load = os.getloadavg()[0]
        took = measure_parts(arguments.build, folder, arguments)
        start = time.monotonic()
        count_instructions(arguments.build, folder)
        took["instructions"] = time.monotonic() - start
        start = time.monotonic()
        measure_compiling(arguments.build, folder, arguments)
        took["compiling"] = time.monotonic() - start
        describe_machine(arguments.build, folder, took, arguments)
    draw_and_write(arguments.output, folder)
    say(f"wrote {arguments.output / 'speed_and_accuracy.md'}")


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: MIT
"""Runs the programs of the study and describes the machine."""
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

from results import ORDERS
from tables import write_csv

PARTS = ("representation", "integrators", "error_terms", "allan")


def say(text):
    print(text, file=sys.stderr, flush=True)


def measure_parts(build, folder, arguments):
    """Runs the parts of the study, which write into the folder; returns how long each took, s."""
    took = {}
    for part in PARTS:
        command = [str(build / "benchmarks" / "study"), "--part", part, "--output", str(folder),
                   "--repetitions", str(arguments.repetitions)]
        command += ["--data", str(arguments.data)] if arguments.data and part == "representation" else []
        command += ["--quick"] if arguments.quick else []
        start = time.monotonic()
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

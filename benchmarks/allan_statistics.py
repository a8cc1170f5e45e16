#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What identify() is worth on simulated logs: how often its intervals cover the truth, how often it finds terms that
are not there, how much it scatters, and whether it warns where its model does not describe the log.

    allan_statistics.py PROGRAM [options]      # PROGRAM is the benchmark identify_logs; prints tables in Markdown
    allan_statistics.py --self-test            # compares the simulator with its theory; exit code 1 if it fails
    allan_statistics.py --read FILE            # the tables again, of a file that --csv wrote

The simulator is allan_logs.py, which does not use the library. Jitter is not simulated: the analysis reads samples,
not stamps. Needs numpy and scipy."""

import argparse
import csv
import dataclasses
import io
import math
import multiprocessing
import os
import pathlib
import subprocess
import sys
import time

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

NAME = "allan_statistics.py"

try:
    import allan_logs
    import allan_logs_self_test
    from allan_log_parts import Grid
    from allan_statistics_tables import report
except ImportError as missing:
    sys.exit(f"{NAME}: the Python package {missing.name} is not installed")

LOGS_A_TASK = 10


def say(text, end="\n"):
    print(text, file=sys.stderr, end=end, flush=True)


def output(text):
    try:
        print(text, flush=True)
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # Python writes again at exit
        say(f"{NAME}: standard output cannot be written: {error.strerror}")
        sys.exit(1)


def fail(text):
    say(f"{NAME}: {text}")
    sys.exit(2)


# --------------------------------------------------------------------------------------------------------- measuring


@dataclasses.dataclass(frozen=True)
class Task:
    case: str
    first: int
    runs: int
    grid: Grid
    seed: int
    program: str


def run_task(task):
    """The rows of a few logs: case, run, truth_X, what the program prints, and the time that simulation took."""
    case = allan_logs.CASES[task.case]
    process, truths, took = None, [], []
    for run in range(task.first, task.first + task.runs):
        start = time.perf_counter()
        signals, truth = case.simulate(task.grid, task.seed, run)
        took.append(time.perf_counter() - start)
        truths.append(truth)
        if process is None:
            command = [task.program, str(signals.shape[1]), repr(task.grid.rate), "--axes", str(len(signals))]
            process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        try:
            process.stdin.write(signals.astype("<f8").tobytes())
        except BrokenPipeError:
            break
    printed, errors = process.communicate()
    if process.returncode != 0:
        raise RuntimeError(f"{task.case}, logs from {task.first} on: {task.program} ended with exit code "
                           f"{process.returncode}: {errors.decode().strip()}")
    table = list(csv.DictReader(io.StringIO(printed.decode())))
    if len(table) != task.runs:
        raise RuntimeError(f"{task.case}, logs from {task.first} on: {task.program} printed {len(table)} lines, "
                           f"expected {task.runs}")
    return [{"case": task.case, "samples": task.grid.samples, "rate": task.grid.rate, "run": task.first + i,
             **{f"truth_{symbol}": value for symbol, value in truths[i].items()},
             **{name: float(value) for name, value in row.items()}, "simulation_seconds": took[i]}
            for i, row in enumerate(table)]


def measure(cases, arguments):
    grid = Grid(round(arguments.hours * 3600 * arguments.rate), arguments.rate)
    tasks = [Task(case, first, min(LOGS_A_TASK, arguments.runs - first), grid, arguments.seed, arguments.program)
             for case in cases for first in range(0, arguments.runs, LOGS_A_TASK)]
    rows, start = [], time.perf_counter()
    with multiprocessing.Pool(arguments.threads) as pool:
        for done, some in enumerate(pool.imap(run_task, tasks), 1):
            rows += some
            say(f"\r{done}/{len(tasks)} {some[0]['case']}, {time.perf_counter() - start:.0f} s".ljust(70), end="")
    say("")
    return rows


def write_rows(rows, path):
    """All or nothing: a file beside the target takes its place when it is complete."""
    names = list(dict.fromkeys(name for row in rows for name in row))
    partial = path.with_name(path.name + ".partial")
    with open(partial, "w", newline="") as file:
        table = csv.DictWriter(file, names, lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    partial.replace(path)


def read_rows(path):
    with open(path, newline="") as file:
        table = csv.DictReader(file)
        if not {"case", "samples", "rate", "run", "N_detected"} <= set(table.fieldnames or ()):
            raise ValueError(f"{path}: the first line does not name the columns that --csv writes")
        rows = [{name: value if name == "case" else float(value) for name, value in row.items() if value != ""}
                for row in table]
    if len({(row["samples"], row["rate"]) for row in rows}) > 1:
        raise ValueError(f"{path}: logs of different lengths or rates, expected those of one run")
    return rows


# ------------------------------------------------------------------------------------------------------------ program


def positive(kind):
    def parse(text):
        value = kind(text)
        if not 0 < value < math.inf:
            raise ValueError
        return value
    parse.__name__ = f"positive {kind.__name__}"
    return parse


def parse_arguments():
    parser = argparse.ArgumentParser(prog=NAME, description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", nargs="?", metavar="PROGRAM", help="the benchmark program identify_logs")
    parser.add_argument("--case", action="append", metavar="NAME",
                        help="only cases whose name contains this; may be repeated")
    parser.add_argument("--list", action="store_true", help="the names of all cases")
    parser.add_argument("--runs", type=positive(int), default=200, help="logs of each case (200)")
    parser.add_argument("--hours", type=positive(float), default=1.0, help="length of a log (1)")
    parser.add_argument("--rate", type=positive(float), default=100.0, help="Hz (100)")
    parser.add_argument("--threads", type=positive(int), default=1, help="processes side by side (1)")
    parser.add_argument("--seed", type=int, default=1, help="another seed, other logs (1)")
    parser.add_argument("--csv", type=pathlib.Path, metavar="FILE", help="writes a line a log")
    parser.add_argument("--read", type=pathlib.Path, metavar="FILE", help="simulates nothing")
    parser.add_argument("--self-test", action="store_true", help="only compares the simulator with its theory")
    arguments = parser.parse_args()
    if arguments.seed < 0:
        parser.error(f"argument --seed: {arguments.seed}, expected a number >= 0")
    if not (arguments.program or arguments.list or arguments.self_test or arguments.read):
        parser.error("PROGRAM is missing: the path of identify_logs")
    return arguments


def main():
    arguments = parse_arguments()
    grid = Grid(round(arguments.hours * 3600 * arguments.rate), arguments.rate)
    if arguments.list:
        output("\n".join(allan_logs.CASES))
        return
    if arguments.self_test:
        short = dataclasses.replace(grid, samples=min(grid.samples, 72000))
        failures = allan_logs_self_test.self_test(short, arguments.seed, output)
        sys.exit(1 if failures else 0)
    wanted = arguments.case or [""]
    cases = [name for name in allan_logs.CASES if any(part in name for part in wanted)]
    if not cases:
        fail(f"--case: no case has {' or '.join(wanted)} in its name; --list names them")
    try:
        if arguments.read:
            rows = [row for row in read_rows(arguments.read) if row["case"] in cases]
            if not rows:
                raise ValueError(f"{arguments.read}: no log of the cases that are asked for")
        else:
            rows = measure(cases, arguments)
        if arguments.csv:
            write_rows(rows, arguments.csv)
    except (OSError, RuntimeError, ValueError) as error:
        fail(error)
    output(report(rows))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What including each public header costs: seconds of CPU and peak memory of looking at a file with nothing else in it
(-std=c++20 -O0 -fsyntax-only), beside Eigen/Dense alone. All files are compiled in turn, so that what else the machine
does meets all of them, and the least of a few runs counts; measure on a quiet machine.

    benchmarks/compile_times.py -I /usr/include/eigen3 -I build/deps/Sophus-pip-1.2.0/include
    benchmarks/compile_times.py --commands build/test/compile_commands.json --check 1.5
"""

import argparse
import json
import os
import pathlib
import shlex
import sys
import tempfile

root = pathlib.Path(__file__).resolve().parent.parent / "include"
dense = "Eigen/Dense"
umbrella = "splinertia/splinertia.hpp"


def flags_of(commands):
    """Include folders and definitions of all commands of a compile_commands.json, each once."""
    flags = []
    for entry in json.loads(pathlib.Path(commands).read_text()):
        words = entry.get("arguments") or shlex.split(entry["command"])
        folder = pathlib.Path(entry["directory"])
        for i, word in enumerate(words):
            found = None
            for option in ("-isystem", "-I"):
                if word == option and i + 1 < len(words):
                    found = ("-isystem", str(folder / words[i + 1]))
                elif word.startswith(option) and word != option:
                    found = ("-isystem", str(folder / word[len(option):]))
            if word.startswith("-DSOPHUS"):
                found = (word,)
            if found and found not in flags:
                flags.append(found)
    return [word for flag in flags for word in flag]


def cost(command):
    """Seconds of CPU (user and system) and peak memory in MB of a command with all that it starts; None if it fails."""
    process = os.posix_spawnp(command[0], command, os.environ, file_actions=[
        (os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0), (os.POSIX_SPAWN_OPEN, 2, os.devnull, os.O_WRONLY, 0)])
    _, status, usage = os.wait4(process, 0)
    if status != 0:
        return None
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--compiler", default=os.environ.get("CXX", "c++"))
    parser.add_argument("-I", "--include", action="append", default=[], metavar="FOLDER",
                        help="where Eigen and Sophus (and Ceres) are")
    parser.add_argument("--commands", metavar="FILE", help="take include folders from this compile_commands.json")
    parser.add_argument("--filter", default="", help="only headers whose name contains this")
    parser.add_argument("--runs", type=int, default=3, help="the least of so many counts (default: 3)")
    parser.add_argument("--csv", action="store_true", help="one line a figure: name,value,unit")
    parser.add_argument("--check", type=float, metavar="SECONDS",
                        help="exit code 1 if a header costs more than this beyond Eigen/Dense")
    options = parser.parse_args()

    flags = ["-std=c++20", "-O0", "-fsyntax-only", "-DSOPHUS_USE_BASIC_LOGGING", "-I", str(root)]
    for folder in options.include:
        flags += ["-isystem", folder]
    if options.commands:
        flags += flags_of(options.commands)

    headers = sorted(str(path.relative_to(root)) for path in root.rglob("*.hpp"))
    with tempfile.TemporaryDirectory() as folder:
        def command(header):
            source = pathlib.Path(folder) / (header.replace("/", "_") + ".cpp")
            source.write_text(f"#include <{header}>\n")
            return [options.compiler, *flags, str(source)]

        if cost(command("ceres/ceres.h")) is None:
            headers = [header for header in headers if "/adapters/" not in header]
            print("compile_times: Ceres is not found, its adapters are left out", file=sys.stderr)
        headers = [header for header in headers if options.filter in header or header == umbrella]
        best, failed = {}, set()
        for _ in range(max(options.runs, 1)):
            for header in [dense, *headers]:
                measured = cost(command(header))
                if measured is None and header != dense:
                    failed.add(header)
                    continue
                if measured is None:
                    sys.exit(f"compile_times: #include <{dense}> does not compile: is Eigen in one of the folders?")
                best[header] = tuple(map(min, measured, best.get(header, measured)))

    for header in sorted(failed):
        print(f"compile_times: {header} does not compile: are all include folders given?", file=sys.stderr)
    headers = [header for header in headers if header not in failed]
    base = best[dense][0]
    if options.csv:
        for header in [dense, *headers]:
            print(f"compile_{header}_seconds,{best[header][0]:.3f},s")
            print(f"compile_{header}_memory,{best[header][1]:.0f},MB")
    else:
        print("| header | s | beyond Eigen/Dense | MB |\n|---|---|---|---|")
        for header in sorted([dense, *headers], key=lambda header: -best[header][0]):
            seconds, memory = best[header]
            print(f"| `{header}` | {seconds:.2f} | {seconds - base:+.2f} | {memory:.0f} |")
    if options.check is not None:
        above = [header for header in headers if best[header][0] - base > options.check]
        for header in above:
            print(f"compile_times: {header} costs {best[header][0] - base:.2f} s beyond {dense}, "
                  f"more than {options.check:g} s", file=sys.stderr)
        return 1 if above or failed else 0
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

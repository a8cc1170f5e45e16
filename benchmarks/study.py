#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The speed/accuracy study: measures on this machine, draws, and writes the page.

    study.py BUILD_DIR [--output docs] [--data GROUNDTRUTH] [--quick]

BUILD_DIR is that of the preset `bench`. GROUNDTRUTH is a real trajectory (TUM, or csv as EuRoC has it). Writes into the
output folder speed_and_accuracy.md and study/: csv, svg and png files. --draw-only makes plots and page again from the
csv files that are there. Needs numpy and matplotlib. Its parts are in the folder study/ beside this file."""

import argparse
import os
import pathlib
import sys
import tempfile
import time

sys.path.append(str(pathlib.Path(__file__).resolve().parent / "study"))

import figures
from measuring import count_instructions, describe_machine, measure_compiling, measure_parts, say
from page import draw_and_write


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
        with tempfile.TemporaryDirectory() as raw:
            took = measure_parts(arguments.build, pathlib.Path(raw), arguments)
            figures.thin(pathlib.Path(raw), folder)
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

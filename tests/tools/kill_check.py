#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Kills programs (SIGKILL) while they replace the files of an earlier run, and looks at what is left.

    kill_check.py WORK_DIR PROGRAMS... [--kills 200]     # simulate_imu, and those of fit_trajectory and allan that there are

A folder has the complete files of one run; another one, with other options and fewer or more files, is killed: half of
the times at random, half as soon as anything in the folder changes. Allowed is what is complete (all files of the one run
or of the other, and its last file) and what is visibly not: the file that appears last is missing. Never are there files
of both runs. Files of somebody else stay, and the next run completes the folder.
"""
import argparse
import os
import pathlib
import random
import shutil
import subprocess
import sys
import time

NOTES = "notes.txt"  # of somebody else


def content(folder):
    """All files but the program's own list."""
    return {path.name: path.read_bytes() for path in folder.iterdir() if not path.name.endswith(".files")}


def look(folder):
    return sorted((entry.name, entry.inode()) for entry in os.scandir(folder))


class Case:
    """A program, the options of two runs, and the file that appears last."""

    def __init__(self, work, program, last, first, second):
        self.name, self.program, self.last, self.second = program.name, program, last, second
        self.folder = work / self.name
        self.before, self.after = work / f"{self.name}.before", work / f"{self.name}.after"
        self.counts = dict.fromkeys(["first run complete", "second run complete", "visibly incomplete"], 0)
        self.run(first, self.before)
        (self.before / NOTES).write_text("of somebody else")
        shutil.copytree(self.before, self.after)
        self.duration = self.run(second, self.after)
        self.sets = content(self.before), content(self.after)
        if self.sets[0].keys() == self.sets[1].keys():
            sys.exit(f"{self.name}: both runs have the same files, expected others")

    def run(self, options, folder):
        start = time.monotonic()
        subprocess.run([self.program, *options, "--output", folder], check=True, stdout=subprocess.DEVNULL)
        return time.monotonic() - start

    def kill(self, aimed):
        shutil.rmtree(self.folder, ignore_errors=True)
        shutil.copytree(self.before, self.folder)  # with the times of the files
        untouched = look(self.folder)
        wait = random.uniform(0, 1.1 * self.duration)
        with subprocess.Popen([self.program, *self.second, "--output", self.folder], stdout=subprocess.DEVNULL) as process:
            if aimed:
                while process.poll() is None and look(self.folder) == untouched:
                    pass
                pause = time.perf_counter() + random.uniform(0, 3e-4)
                while time.perf_counter() < pause:
                    pass
            else:
                time.sleep(wait)
            process.kill()
        self.judge(f"{'aimed' if aimed else f'after {wait:.3f} s'}")

    def judge(self, how):
        left = content(self.folder)
        for name in [name for name in left if name.startswith(".splinertia.") and name.endswith(".tmp")]:
            del left[name]  # what is complete is judged without; a kill may leave one
        if left.get(NOTES) != b"of somebody else":
            sys.exit(f"{self.name}, killed {how}: {NOTES} is not as it was")
        if self.last in left:
            if left not in self.sets:
                sys.exit(f"{self.name}, killed {how}: {self.last} is there with a mixture: {sorted(left)}")
            self.counts["first run complete" if left == self.sets[0] else "second run complete"] += 1
            return
        self.counts["visibly incomplete"] += 1
        if not any(left.items() <= whole.items() for whole in self.sets):
            sys.exit(f"{self.name}, killed {how}: files of both runs are there: {sorted(left)}")
        self.run(self.second, self.folder)
        if content(self.folder) != self.sets[1]:
            sys.exit(f"{self.name}, killed {how}: the next run has not completed the folder: {sorted(content(self.folder))}")


def cases(work, programs):
    poses, imu = work / "input/poses.tum", work / "input/imu.csv"
    simulate = programs["simulate_imu"]
    subprocess.run([simulate, "--motion", "rest", "--duration", "6", "--seed", "3", "--output", work / "input"], check=True,
                   stdout=subprocess.DEVNULL)
    found = [Case(work, simulate, "imu.csv", ["--duration", "2", "--seed", "1"],
                  ["--duration", "2", "--seed", "2", "--npy", "--preset", "ideal"])]
    if program := programs.get("fit_trajectory"):
        found.append(Case(work, program, "control_points.csv", [poses, "--knot-interval", "0.5", "--no-plot", "--imu", imu],
                          [poses, "--knot-interval", "0.4", "--no-plot", "--rate", "100"]))
    if program := programs.get("allan"):
        found.append(Case(work, program, "curves.csv", [imu, "--no-plot", "--estimators", "kalibr,vins"],
                          [imu, "--no-plot", "--skip", "1", "--estimators", "kalibr"]))
    return found


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("work", type=pathlib.Path)
    arguments.add_argument("programs", type=pathlib.Path, nargs="+")
    arguments.add_argument("--kills", type=int, default=200, help="of each program (%(default)s)")
    given = arguments.parse_args()
    shutil.rmtree(given.work, ignore_errors=True)
    given.work.mkdir(parents=True)
    random.seed(1)
    for case in cases(given.work, {program.name: program for program in given.programs}):
        for i in range(given.kills):
            case.kill(aimed=i % 2 == 1)
        print(f"{case.name}: {given.kills} kills, " + ", ".join(f"{name} {count}" for name, count in case.counts.items()))


if __name__ == "__main__":
    main()

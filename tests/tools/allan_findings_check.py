#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs allan on logs of which something is wrong, and checks what its files say of it.

    allan_findings_check.py ALLAN FOLDER     # the program, and a folder for logs and results
"""
import csv
import math
import pathlib
import random
import subprocess
import sys

RATE, SAMPLES, N = 100, 60000, 1e-3
SIGMA = N * math.sqrt(RATE)


def white(seed):
    generator = random.Random(seed)
    return [generator.gauss(0, SIGMA) for _ in range(SAMPLES)]


def resonance(seed, frequency, quality, deviation):
    """White noise through two poles."""
    angle = 2 * math.pi * frequency / RATE
    radius = math.exp(-angle / (2 * quality))
    generator = random.Random(seed)
    signal = [0.0, 0.0]
    while len(signal) < SAMPLES:
        signal.append(2 * radius * math.cos(angle) * signal[-1] - radius**2 * signal[-2] + generator.gauss(0, 1))
    size = math.sqrt(sum(value * value for value in signal) / SAMPLES)
    return [value * deviation / size for value in signal]


class Result:
    def __init__(self, program, folder, name, axes, *options):
        self.folder = folder / name
        log = folder / f"{name}.csv"
        log.write_text("".join(",".join(f"{value:.9g}" for value in row) + "\n" for row in zip(*axes)))
        columns = ["gx", "gy", "gz", "ax", "ay", "az"][: len(axes)]
        run = subprocess.run([program, log, "--rate", str(RATE), "--columns", ",".join(columns), "--output", self.folder,
                              "--no-plot", *options], capture_output=True, text=True)
        check(run.returncode == 0, f"{name}: exit code {run.returncode}: {run.stderr}")
        self.name, self.text = name, run.stdout
        with open(self.folder / "noise.csv", newline="") as file:
            self.rows = {(row["#sensor"], row["axis"], row["term"]): row for row in csv.DictReader(file)}
        with open(self.folder / "findings.csv", newline="") as file:
            self.findings = list(csv.DictReader(file))

    def row(self, term, axis="x", sensor="gyroscope"):
        return self.rows[sensor, axis, term]

    def detected(self, term, axis="x"):
        row = self.rows.get(("gyroscope", axis, term))
        return row is not None and row["detected"] == "1"

    def found(self, kind, axis="x"):
        return [row for row in self.findings if row["kind"] == kind and row["axis"] == axis]

    def near(self, term, truth, share, axis="x"):
        value = float(self.row(term, axis)["estimate"])
        check(abs(value / truth - 1) < share, f"{self.name}: {term} of {axis} is {value}, expected {truth}")


def check(condition, text):
    if not condition:
        sys.exit(f"allan_findings_check.py: {text}")


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)

    def analyse(name, axes, *options):
        return Result(program, folder, name, axes, *options)

    good = analyse("good", [white(1), white(2), white(3)])
    check(good.row("N", "all")["adequacy"] == "adequate", "white noise is not described")
    check(not any(good.detected(term, "all") for term in "KBQRGW"), "white noise has other terms")
    check({row["kind"] for row in good.findings} == {"log", "fit"}, f"findings of white noise: {good.findings}")

    step = analyse("step", [[value + (SIGMA if i >= 25000 else 0) for i, value in enumerate(white(4))]])
    check(not any(step.detected(term) for term in "KBRGW"), "a step is a slow term")
    place = step.found("step")
    check(len(place) == 1 and abs(float(place[0]["from"]) - 250) < 3, f"a step at 250 s: {place}")
    check("--skip" in place[0]["text"], f"a step, how to leave it out: {place[0]['text']}")
    check(step.row("N")["adequacy"] == "partial" and step.row("K")["estimate"] == "nan", "a step, its adequacy")
    step.near("N", N, 0.02)
    after = analyse("after_step", [[value + (SIGMA if i >= 25000 else 0) for i, value in enumerate(white(4))]], "--skip", "255")
    check(after.row("N")["adequacy"] == "adequate" and not after.detected("K"), "behind a step all is well")

    signal = white(5)
    signal[20000:28000] = [signal[20000]] * 8000
    freeze = analyse("freeze", [signal])
    place = freeze.found("freeze")
    check(len(place) == 1 and abs(float(place[0]["from"]) - 200) < 1 and abs(float(place[0]["to"]) - 280) < 1, f"a freeze: {place}")
    check(freeze.row("N")["adequacy"] == "inadequate" and freeze.row("N")["lower"] == "nan", "a freeze, its adequacy")
    check(not any(freeze.detected(term) for term in "KBRGW"), "a freeze is a slow term")
    without = analyse("without_freeze", [signal], "--leave-out", "200-280")
    check(without.row("N")["adequacy"] == "adequate", "without the freeze all is well")
    without.near("N", N, 0.02)

    sway = analyse("sway", [[a + b for a, b in zip(white(6), resonance(7, 0.6, 10, SIGMA / 2))]])
    check(not any(sway.detected(term) for term in "KBQRGW"), "a resonance is another term")
    sway.near("N", N, 0.02)
    check(any(float(row["from"]) < 0.6 < float(row["to"]) for row in sway.found("excluded")), "the band of a resonance")
    check(sway.row("N")["adequacy"] == "partial", "a resonance, its adequacy")
    by_hand = analyse("by_hand", [white(8)], "--exclude", "0.4-0.8", "--exclude", "5-6")
    check([(round(float(row["from"]), 1), round(float(row["to"]), 1)) for row in by_hand.found("excluded")] == [(0.4, 0.8), (5, 6)],
          f"bands left out by hand: {by_hand.found('excluded')}")

    axes = [white(9), [4 * value for value in white(10)], [1.5 * value for value in white(11)],
            white(12), white(13), [9.81 + value for value in white(14)]]
    differ = analyse("differ", axes)
    check(("gyroscope", "all", "N") not in differ.rows, "axes that differ have a common row")
    check(("accelerometer", "all", "N") in differ.rows, "axes that agree have none")
    differ.near("N", 4 * N, 0.02, "y")
    yaml = (differ.folder / "imu.yaml").read_text()
    check("gyroscope_noise_density: from axis y, the largest" in yaml, f"imu.yaml does not say which axis: {yaml}")
    check("WARNING" not in yaml, f"imu.yaml warns of what is well: {yaml}")
    axes[0] = [value + (SIGMA if i >= 25000 else 0) for i, value in enumerate(axes[0])]
    yaml = (analyse("step_of_six", axes).folder / "imu.yaml").read_text()
    check("# WARNING gyroscope x: a step of" in yaml, f"imu.yaml does not warn of a step: {yaml}")

    generator = random.Random(15)
    kept, walk = 0.0, []
    for value in white(16):
        kept = math.exp(-1 / (5 * RATE)) * kept + generator.gauss(0, 8e-5)
        walk.append(value + kept)
    markov = analyse("gauss_markov", [walk])
    check(markov.detected("G") and not any(markov.detected(term) for term in "KBQR"), "a Gauss-Markov bias is another term")
    check(float(markov.row("G")["time_lower"]) < 5 < float(markov.row("G")["time_upper"]), f"its time: {markov.row('G')}")

    weak = analyse("weak_ramp", [[value + 1.5e-6 * i / RATE for i, value in enumerate(white(17))]])
    check(not weak.detected("K"), "a ramp is a walk")
    check(weak.row("R")["status"] == "detected" or "cannot be told apart" in weak.found("descriptions")[0]["text"],
          "a ramp that may be something else")

    degrees = analyse("degrees", [[60 * value for value in white(18)]])
    check("--gyro-unit deg/s" in degrees.found("white_noise")[0]["text"], "white noise that no gyroscope has")
    coarse = analyse("coarse", [[4 * SIGMA * round(value / (4 * SIGMA)) for value in white(19)]])
    check(coarse.row("N")["adequacy"] == "inadequate" and coarse.found("resolution"), "a coarse resolution")


if __name__ == "__main__":
    main()

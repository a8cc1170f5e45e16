"""Runs compare_trajectories and the programs evo_ape and evo_rpe on the same files: every statistic must agree.

    compare_with_evo.py PROGRAM EVO_APE WORK_DIR REFERENCE ESTIMATE

EVO_APE is that program, with evo_rpe beside it; ESTIMATE may be "perturb": made of the reference, in another frame, of
another scale, with noise, at other times.
"""

import csv
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import zipfile

statistics = ["rmse", "mean", "median", "std", "min", "max", "sse"]
alignments = {"none": [], "origin": ["--align_origin"], "se3": ["--align"], "sim3": ["--align", "--correct_scale"]}
parts = {"translation": "trans_part", "rotation": "angle_deg"}
deltas = [(1, "frames", False), (10, "frames", False), (10, "frames", True), (0.5, "m", False), (0.5, "m", True)]


def product(a, b):
    (w, x, y, z), (W, X, Y, Z) = a, b
    return (w * W - x * X - y * Y - z * Z, w * X + x * W + y * Z - z * Y, w * Y - x * Z + y * W + z * X,
            w * Z + x * Y - y * X + z * W)


def perturb(reference, estimate):
    """Every third row of a EuRoC file, as a TUM file."""
    noise = random.Random(1)
    frame = (0.2, 0.4, 0.4, 0.8)
    inverse = (0.2, -0.4, -0.4, -0.8)
    rows = [line.split(",") for line in open(reference) if not line.startswith("#")]
    with open(estimate, "w") as file:
        for i, row in list(enumerate(rows))[::3]:
            drift = i / len(rows)
            time = int(row[0]) + noise.randint(-6_000_000, 6_000_000)
            p = [1.07 * float(v) + noise.gauss(0, 0.02) + 0.3 * drift**2 for v in row[1:4]]
            p = product(product(frame, (0, *p)), inverse)[1:]
            turn = (1, *(noise.gauss(0, 0.005) + 0.03 * drift for _ in range(3)))
            q = product(product(frame, [float(v) for v in row[4:8]]), turn)
            norm = math.sqrt(sum(c * c for c in q))
            w, x, y, z = (c / norm for c in q)
            print(f"{time // 10**9}.{time % 10**9:09d}", *map(repr, (p[0] + 3, p[1] - 2, p[2] + 10, x, y, z, w)), file=file)


def evo(program, work, reference, estimate, options):
    results = work / "evo.zip"
    results.unlink(missing_ok=True)
    kind = "euroc" if reference.suffix == ".csv" else "tum"
    subprocess.run([program, kind, reference, estimate, *options, "--save_results", results, "--no_warnings"], check=True,
                   stdout=subprocess.DEVNULL, env=dict(os.environ, HOME=str(work)))
    with zipfile.ZipFile(results) as file:
        return json.loads(file.read("stats.json"))


def ours(program, work, reference, estimate, options):
    table = work / "ours.csv"
    subprocess.run([program, reference, estimate, *options, "--csv", table], check=True, stdout=subprocess.DEVNULL)
    with open(table) as file:
        return {(row["metric"], row["part"]): row for row in csv.DictReader(file)}


def main():
    program, evo_ape = sys.argv[1:3]
    evo_rpe = str(pathlib.Path(evo_ape).with_name("evo_rpe"))
    work, reference = map(pathlib.Path, sys.argv[3:5])
    estimate = pathlib.Path(sys.argv[5])
    if sys.argv[5] == "perturb":
        estimate = work / "perturbed.tum"
        perturb(reference, estimate)
    worst = 0

    def check(what, mine, theirs):
        nonlocal worst
        for name in statistics:
            a, b = float(mine[name]), theirs[name]
            # Errors that ought to be zero are rounding, 1e-14 of the size of the poses.
            if not abs(a - b) <= 1e-9 * abs(b) + 1e-12:
                sys.exit(f"{what}: {name} is {a!r}, evo says {b!r}")
            if abs(b) > 1e-6:
                worst = max(worst, abs(a / b - 1))

    for kind, options in alignments.items():
        table = ours(program, work, reference, estimate, ["--align", kind])
        for part, relation in parts.items():
            theirs = evo(evo_ape, work, reference, estimate, [*options, "-r", relation])
            check(f"ATE {part} {kind}", table["ATE", part], theirs)
    for delta, unit, every in deltas:
        table = ours(program, work, reference, estimate,
                     ["--align", "sim3", "--delta", str(delta), "--delta-unit", unit] + ["--all-pairs"] * every)
        for part, relation in parts.items():
            options = ["-r", relation, "--delta", str(delta), "--delta_unit", unit[0]] + ["--all_pairs"] * every
            theirs = evo(evo_rpe, work, reference, estimate, [*alignments["sim3"], *options])
            check(f"RPE {part} over {delta} {unit}{', all pairs' * every}", table["RPE", part], theirs)
    # The first pairs alone align; the estimate's stamps are shifted.
    for kind in "se3", "sim3":
        table = ours(program, work, reference, estimate, ["--align", kind, "--align-poses", "17"])
        theirs = evo(evo_ape, work, reference, estimate, [*alignments[kind], "--n_to_align", "17", "-r", "trans_part"])
        check(f"ATE {kind} of 17 pairs", table["ATE", "translation"], theirs)
    for offset in "0.0037", "-0.21":
        table = ours(program, work, reference, estimate, ["--align", "se3", "--time-offset", offset])
        theirs = evo(evo_ape, work, reference, estimate, ["--align", f"--t_offset={offset}", "-r", "trans_part"])
        check(f"ATE with {offset} s", table["ATE", "translation"], theirs)
    print(f"{estimate.name}: agrees with evo to {worst:.1e}")


main()

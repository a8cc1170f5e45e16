"""Runs compare_trajectories and computes from the definitions what evo does not have: RPE over seconds, alignment of
heading and translation, drift over lengths of path. Needs Python alone.

    compare_by_definition.py PROGRAM WORK_DIR REFERENCE ESTIMATE LENGTH...
"""

import bisect
import csv
import math
import pathlib
import subprocess
import sys


def product(a, b):
    (w, x, y, z), (W, X, Y, Z) = a, b
    return (w * W - x * X - y * Y - z * Z, w * X + x * W + y * Z - z * Y, w * Y - x * Z + y * W + z * X,
            w * Z + x * Y - y * X + z * W)


def inverse(q):
    return (q[0], -q[1], -q[2], -q[3])


def rotated(q, v):
    return product(product(q, (0, *v)), inverse(q))[1:]


def angle(q):
    return math.degrees(2 * math.atan2(math.hypot(*q[1:]), abs(q[0])))


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def read(path):
    """(ns, position, quaternion wxyz) of each row of a TUM or EuRoC file."""
    poses = []
    for line in open(path):
        if line.startswith("#"):
            continue
        if path.suffix == ".csv":
            stamp, *numbers = line.split(",")
            p, q = numbers[:3], numbers[3:7]
            time = int(stamp)
        else:
            stamp, *numbers = line.split()
            p, q = numbers[:3], numbers[6:7] + numbers[3:6]
            whole, _, rest = stamp.partition(".")
            time = int(whole) * 10**9 + int(rest.ljust(9, "0"))
        q = [float(c) for c in q]
        norm = math.sqrt(sum(c * c for c in q))
        poses.append((time, [float(c) for c in p], [c / norm for c in q]))
    return poses


def paired(reference, estimate):
    """(time, reference, estimate): each pose of the shorter with the nearest of the longer, at most 10 ms apart."""
    def nearest(poses, times, time):
        i = bisect.bisect_left(times, time)
        return min(poses[max(i - 1, 0):i + 1], key=lambda pose: abs(pose[0] - time))
    swapped = len(estimate) > len(reference)
    short, long = (reference, estimate) if swapped else (estimate, reference)
    times = [pose[0] for pose in long]
    pairs = []
    for pose in short:
        other = nearest(long, times, pose[0])
        if abs(other[0] - pose[0]) <= 10**7:
            r, e = (pose, other) if swapped else (other, pose)
            pairs.append((e[0], r, e))
    return pairs


def motion(a, b):
    return rotated(inverse(a[2]), minus(b[1], a[1])), product(inverse(a[2]), b[2])


def relative(pairs, i, j):
    (p_r, q_r), (p_e, q_e) = motion(pairs[i][1], pairs[j][1]), motion(pairs[i][2], pairs[j][2])
    return math.hypot(*minus(p_e, p_r)), angle(product(inverse(q_r), q_e))


def by_time(pairs, delta, every):
    """The pair whose time is nearest, to within a tenth."""
    times = [pair[0] for pair in pairs]
    indices, i = [], 0
    while i + 1 < len(pairs):
        k = bisect.bisect_left(times, times[i] + delta * 10**9)
        j = min(range(max(i + 1, min(k - 1, len(pairs) - 1)), min(k + 1, len(pairs))) or [len(pairs) - 1],
                key=lambda m: abs(times[m] - times[i] - delta * 10**9))
        near = abs(times[j] - times[i] - delta * 10**9) <= delta * 10**8
        if near:
            indices.append((i, j))
        i = j if near and not every else i + 1
    return indices


def drift(pairs, length):
    path = [0]
    for (_, a, _), (_, b, _) in zip(pairs, pairs[1:]):
        path.append(path[-1] + math.hypot(*minus(b[1], a[1])))
    ends = ((i, next((j for j in range(i, len(path)) if path[j] > path[i] + length), None))
            for i in range(0, len(path), 10))
    return [(100 * t / length, r / length) for t, r in (relative(pairs, i, j) for i, j in ends if j is not None)]


def yaw_rmse(pairs):
    """The least root mean square over headings, each with its best translation; by search."""
    def rmse(yaw):
        q = (math.cos(yaw / 2), 0, 0, math.sin(yaw / 2))
        left = [minus(r[1], rotated(q, e[1])) for _, r, e in pairs]
        mean = [sum(axis) / len(left) for axis in zip(*left)]
        return math.sqrt(sum(math.hypot(*minus(v, mean))**2 for v in left) / len(left))
    best = min((k * math.pi / 18 for k in range(36)), key=rmse)
    low, high = best - 0.2, best + 0.2
    for _ in range(60):
        a, b = low + (high - low) * 0.382, low + (high - low) * 0.618
        low, high = (low, b) if rmse(a) < rmse(b) else (a, high)
    return rmse((low + high) / 2)


def main():
    program = sys.argv[1]
    work, reference, estimate = map(pathlib.Path, sys.argv[2:5])
    lengths = sys.argv[5:]

    def ours(*options):
        table = work / "ours.csv"
        subprocess.run([program, reference, estimate, *options, "--csv", table], check=True, stdout=subprocess.DEVNULL)
        with open(table) as file:
            return {(row["metric"], row["part"]): row for row in csv.DictReader(file)}

    def check(what, mine, theirs):
        if not abs(float(mine) - theirs) <= 1e-9 * abs(theirs) + 1e-12:
            sys.exit(f"{what} is {mine}, expected {theirs!r}")

    pairs = paired(read(reference), read(estimate))
    for delta in 0.1, 0.5, 1.0:
        for every in False, True:
            table = ours("--delta", str(delta), "--delta-unit", "s", *["--all-pairs"] * every)
            errors = [relative(pairs, i, j) for i, j in by_time(pairs, delta, every)]
            for part, values in zip(("translation", "rotation"), zip(*errors)):
                check(f"RPE {part} over {delta} s, count", table["RPE", part]["count"], len(values))
                check(f"RPE {part} over {delta} s", table["RPE", part]["mean"], sum(values) / len(values))
                check(f"RPE {part} over {delta} s, max", table["RPE", part]["max"], max(values))
    table, everything = ours("--lengths", *lengths), []
    for length in lengths:
        errors = drift(pairs, float(length))
        everything += errors
        for part, values in zip(("translation", "rotation"), zip(*errors)):
            row = table[f"drift {length} m", part]
            check(f"drift {part} over {length} m, count", row["count"], len(values))
            check(f"drift {part} over {length} m", row["mean"], sum(values) / len(values))
    for part, values in zip(("translation", "rotation"), zip(*everything)):
        check(f"drift {part}", table["drift", part]["mean"], sum(values) / len(values))
    check("ATE aligned in yaw", ours("--align", "yaw")["ATE", "translation"]["rmse"], yaw_rmse(pairs))
    print(f"{estimate.name}: RPE over seconds, drift and alignment in yaw are as defined")


main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The overlapping Allan deviation by the Python package allantools, beside the benchmark program allan_analysis.

    allan_allantools.py PROGRAM [SAMPLES [REPETITIONS]]     # 10000000 and 5; prints name,value,unit

Both take the same log and averaging times, one after the other, so that what else the machine does meets both. What is
timed is from the log in memory to the deviations.
"""
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time


def main():
    if not 2 <= len(sys.argv) <= 4 or sys.argv[1] in ("-h", "--help"):
        print(__doc__)
        sys.exit(0 if len(sys.argv) == 2 else 2)
    try:
        import allantools
        import numpy
    except ImportError:
        sys.exit("allan_allantools.py: the Python package allantools is not installed")
    program, *numbers = sys.argv[1:]
    samples, repetitions = map(int, numbers + ["10000000", "5"][len(numbers):])
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "samples"
        subprocess.run([program, "--write-samples", path, "--samples", str(samples)], check=True)
        log = numpy.fromfile(path)
        ours, theirs = [], []
        for _ in range(repetitions):
            printed = subprocess.run([program, "--analyse", path], check=True, capture_output=True, text=True).stdout
            first, *rest = printed.split()
            ours.append(float(first))
            factors, deviations = numpy.array([[float(x) for x in line.split(",")] for line in rest]).T
            start = time.perf_counter()
            taus, reference, _, _ = allantools.oadev(log, rate=200.0, data_type="freq", taus=factors / 200.0)
            theirs.append(time.perf_counter() - start)
    # allantools leaves out what it has no, or one, difference for.
    places = numpy.searchsorted(factors, numpy.round(taus * 200.0))
    worst = numpy.max(numpy.abs(reference / deviations[places] - 1))
    ratios = [b / a for a, b in zip(ours, theirs)]
    for name, values, unit in (("s_splinertia", ours, "s"), ("s_allantools", theirs, "s"), ("times_as_fast", ratios, "1")):
        for suffix, value in (("min", min(values)), ("median", statistics.median(values)), ("max", max(values))):
            print(f"{name}_{suffix},{value:.4g},{unit}")
    print(f"taus,{len(places)},1")
    print(f"largest_relative_difference,{worst:.3g},1")


if __name__ == "__main__":
    main()

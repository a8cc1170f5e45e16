#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The overlapping Allan deviation by the Python package allantools, beside the benchmark program allan_analysis.

    allan_allantools.py PROGRAM [SAMPLES [REPETITIONS]]           # 10000000 and 5; prints name,value,unit
    allan_allantools.py --text ALLAN [SAMPLES [REPETITIONS]]      # the program allan, from a text file

Both take the same log and averaging times, one after the other, so that other load of the machine slows both. The time
is that from the log in memory to the deviations. With --text it is from a file with one number of 17 digits per line,
which allantools reads by numpy.loadtxt; the time of Python's imports is left out.
"""
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time


def print_times(ours, theirs):
    ratios = [b / a for a, b in zip(ours, theirs)]
    for name, values, unit in (("s_splinertia", ours, "s"), ("s_allantools", theirs, "s"),
                               ("times_as_fast", ratios, "1")):
        for suffix, value in (("min", min(values)), ("median", statistics.median(values)), ("max", max(values))):
            print(f"{name}_{suffix},{value:.4g},{unit}")


def compare_text(allantools, numpy, program, samples, repetitions):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "numbers.txt"
        numpy.savetxt(path, numpy.random.default_rng(1).standard_normal(samples), fmt="%.17g")
        ours, theirs = [], []
        for _ in range(repetitions):
            start = time.perf_counter()
            subprocess.run([program, "deviation", "--rate", "200", path], check=True, capture_output=True)
            ours.append(time.perf_counter() - start)
            start = time.perf_counter()
            allantools.oadev(numpy.loadtxt(path), rate=200.0, data_type="freq", taus="octave")
            theirs.append(time.perf_counter() - start)
    print_times(ours, theirs)


def main():
    text = "--text" in sys.argv[1:2]
    if text:
        del sys.argv[1]
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
    if text:
        compare_text(allantools, numpy, program, samples, repetitions)
        return
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
    print_times(ours, theirs)
    print(f"taus,{len(places)},1")
    print(f"largest_relative_difference,{worst:.3g},1")


if __name__ == "__main__":
    main()

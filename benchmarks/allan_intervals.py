#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How often intervals of the overlapping Allan deviation hold at long averaging times, by two rules for the noise type.

    allan_intervals.py PROGRAM [LOGS]     # PROGRAM: tools/allan; 2000 logs a case; prints a table, needs numpy

The interval depends on the power law alpha of the noise, which has to be identified from few averages there.
  ours      the alpha of PROGRAM: below 30 averages that of the longest time with so many, and at most 0
  Stable32  its rule as far as it is known: below 30 averages the ratio B1 of the variance of the averages to their
            Allan variance (Barnes, NBS Technical Note 375, 1969), compared with what it is for each alpha; alpha 1
            stands for 1 and 2. Below 7 averages, where B1 says little, the alpha of the time before.
  known     the alpha that the noise has, -2 for white noise with a random walk
A rule is good if its intervals of 68.3 % hold in 68.3 % of the logs, and those of 95 % in 95 %.
"""
import subprocess
import sys

SAMPLES = 1800
AVERAGES = (30, 20, 15, 10, 7, 5, 4, 3, 2)  # of the whole log
ALPHAS = (2, 1, 0, -1, -2)
CASES = {"white": 0, "flicker": -1, "walk": -2, "white + walk, equal at T/30": -2, "white + walk, equal at T/10": -2}


def run(program, rates, *options):
    """The rows of `PROGRAM deviation`: deviation, lower, upper, alpha at each factor."""
    factors = ",".join(str(SAMPLES // n) for n in AVERAGES)
    text = "\n".join(repr(float(y)) for y in rates)
    printed = subprocess.run([program, "deviation", "--intervals", "exact", "--factors", factors, *options, "-"],
                             input=text, check=True, capture_output=True, text=True).stdout
    rows = [line.split(",") for line in printed.split()[1:]]
    return [[float(row[i]) for i in (3, 4, 5)] + [int(row[6])] for row in rows]


def flicker_spectrum(numpy):
    """Frequencies and spectral density of flicker noise with a period of 32 logs, without its mean."""
    f = numpy.fft.rfftfreq(32 * SAMPLES)[1:]
    return f, 1 / (2 * numpy.sin(numpy.pi * f))


def simulated(numpy, case, random):
    white = random.standard_normal(SAMPLES)
    if case == "white":
        return white
    if case == "flicker":
        f, density = flicker_spectrum(numpy)
        spectrum = numpy.fft.rfft(random.standard_normal(32 * SAMPLES))
        spectrum[0] = 0
        spectrum[1:] *= numpy.sqrt(density)
        return numpy.fft.irfft(spectrum)[:SAMPLES]
    walk = numpy.cumsum(random.standard_normal(SAMPLES))
    if case == "walk":
        return walk
    return white + walk * 3**0.5 * int(case.split("/")[1]) / SAMPLES


def true_deviation(numpy, case, m):
    white, walk = 1 / m, (2 * m * m + 1) / (6 * m)
    if case == "white":
        return white**0.5
    if case == "flicker":
        f, density = flicker_spectrum(numpy)
        weights = numpy.full(len(f), 2.0)
        weights[-1] = 1  # the Nyquist frequency has no twin
        gain = 2 * numpy.sin(numpy.pi * m * f)**4 / (m * numpy.sin(numpy.pi * f))**2
        return (numpy.sum(weights * density * gain) / (32 * SAMPLES))**0.5
    if case == "walk":
        return walk**0.5
    return (white + walk * 3 * (int(case.split("/")[1]) / SAMPLES)**2)**0.5


def b1_alpha(numpy, rates, m):
    """The alpha of Barnes' B1, of which 1 stands for 1 and 2. Boundaries are geometric means of the expected ratios."""
    n = len(rates) // m
    averages = rates[:n * m].reshape(n, m).mean(axis=1)
    ratio = numpy.var(averages, ddof=1) / numpy.mean(numpy.diff(averages)**2 / 2)
    expected = [n * numpy.log(n) / (2 * (n - 1) * numpy.log(2)) if mu == 0
                else n * (1 - float(n)**mu) / (2 * (n - 1) * (1 - 2.0**mu)) for mu in (-2, -1, 0, 1)]
    return 1 - sum(ratio > (low * high)**0.5 for low, high in zip(expected, expected[1:]))


def stable32_alphas(numpy, rates, identified):
    """As Stable32 presumably does; `identified` are the alphas by lag-1 autocorrelation of 30 averages and more."""
    alphas = []
    for n, alpha in zip(AVERAGES, identified):
        alphas.append(alpha if n >= 30 else b1_alpha(numpy, rates, SAMPLES // n) if n >= 7 else alphas[-1])
    return alphas


def main():
    if not 2 <= len(sys.argv) <= 3 or sys.argv[1] in ("-h", "--help"):
        print(__doc__)
        sys.exit(0 if len(sys.argv) == 2 else 2)
    try:
        import numpy
    except ImportError:
        sys.exit("allan_intervals.py: the Python package numpy is not installed")
    program, logs = sys.argv[1], int((sys.argv[2:] or ["2000"])[0])
    random = numpy.random.default_rng(16)
    any_log = random.standard_normal(SAMPLES)
    # The ends of the interval over the deviation, of each alpha and confidence.
    ends = {}
    for confidence in ("0.683", "0.95"):
        for alpha in ALPHAS:
            rows = run(program, any_log, "--alpha", str(alpha), "--confidence", confidence)
            ends[confidence, alpha] = [(lower / deviation, upper / deviation) for deviation, lower, upper, _ in rows]
    print("| noise | alpha | " + " | ".join(f"T/{n}" for n in AVERAGES) + " |")
    print("|---|---|" + "---|" * len(AVERAGES))
    for case, known in CASES.items():
        truth = [true_deviation(numpy, case, SAMPLES // n) for n in AVERAGES]
        inside = {}
        for _ in range(logs):
            rates = simulated(numpy, case, random)
            rows = run(program, rates)
            identified = [row[3] for row in rows]
            rules = {"ours": identified, "Stable32": stable32_alphas(numpy, rates, identified),
                     "known": [known] * len(AVERAGES)}
            for rule, alphas in rules.items():
                for confidence in ("0.683", "0.95"):
                    for i, alpha in enumerate(alphas):
                        lower, upper = ends[confidence, max(alpha, -2)][i]
                        key = rule, confidence, i
                        inside[key] = inside.get(key, 0) + (lower <= truth[i] / rows[i][0] <= upper)
        for rule in ("ours", "Stable32", "known"):
            cells = (" / ".join(f"{100 * inside[rule, c, i] / logs:.0f}" for c in ("0.683", "0.95"))
                     for i in range(len(AVERAGES)))
            print(f"| {case} | {rule} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()

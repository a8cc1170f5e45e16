# SPDX-License-Identifier: MIT
"""Compares the logs of allan_logs.py with their theory."""
import math

import numpy as np
import scipy.optimize
import scipy.signal
import scipy.stats

from allan_log_parts import WHITE, Flicker, Line, Quantization, Step, Trend, Walk, gauss_markov_spectrum
from allan_logs import CASES, as_it_is


def octaves(frequency):
    """Index ranges of octaves, from the eighth frequency on: below, the window spreads a steep spectrum."""
    first = 8
    while first < len(frequency):
        yield first, min(2 * first, len(frequency))
        first *= 2


def spectrum_error(case, grid, logs, seed):
    """The largest deviation of the mean periodogram of an octave from the parts' spectra, in standard errors."""
    sums = np.zeros(grid.samples // 2 + 1)
    expected = np.zeros_like(sums)
    count = 0
    for run in range(logs):
        signals, truth = case.simulate(grid, seed, run)
        for parts, signal in zip(case.parts(grid), signals):
            # What is left out of a log shortens it: the same frequencies belong to all but the same indices.
            signal = np.append(signal, np.full(grid.samples - len(signal), signal[-1]))
            frequency, one_sided = scipy.signal.welch(signal, grid.rate, "hann", grid.samples, 0)
            inside = slice(1, None)
            sums += one_sided / 2
            model = sum(part.spectrum(frequency[inside], grid) for part in parts)
            if case.finish is not as_it_is and "Q" in truth:
                model = model + Quantization(truth["Q"]).spectrum(frequency[inside], grid)
            elif truth["N"] != WHITE and len(parts) == 1 and len(signals) == 1:
                model = model * (truth["N"] / WHITE) ** 2  # rounded
            expected[inside] += model
            count += 1
    used = np.ones(len(sums), bool)
    for line in (part for part in case.parts(grid)[0] if isinstance(part, Line)):
        f = abs(line.frequency - grid.rate * round(line.frequency / grid.rate))
        used &= np.abs(frequency - f) > 20 * grid.rate / grid.samples + line.frequency * line.drift
    worst = 0.0
    for first, last in octaves(frequency[:-1]):
        inside = np.flatnonzero(used[first:last]) + first
        if len(inside) < 4:
            continue
        ratio = np.mean(sums[inside] / expected[inside])
        # A Hann window correlates the periodogram of neighbours by 4/9, and of those next to them by 1/36.
        freedom = 2 * count * len(inside) / (1 + 2 * (4 / 9 + 1 / 36))
        spread = 2 / (9 * freedom)
        worst = max(worst, abs(np.cbrt(ratio) - (1 - spread)) / math.sqrt(spread))
    return worst


def trend_error(case, grid, logs, seed):
    """Fits the trends of a case with white noise by least squares; the deviation of the mean magnitude, in standard
    errors. A step: the means of the first and the last tenth."""
    trend = next(part for part in case.parts(grid)[0] if isinstance(part, (Trend, Step)))
    found = []
    for run in range(logs):
        signal = case.simulate(grid, seed, run)[0][0]
        if isinstance(trend, Step):
            tenth = grid.samples // 10
            found.append(abs(signal[-tenth:].mean() - signal[:tenth].mean()))
            error, expected = grid.sigma * math.sqrt(2 / tenth), trend.height
        else:
            shape = trend.shape(grid)
            design = np.column_stack([np.ones_like(shape), shape])
            found.append(abs(np.linalg.lstsq(design, signal, rcond=None)[0][1]))
            error = grid.sigma * math.sqrt(np.linalg.inv(design.T @ design)[1, 1])
            expected = trend.amplitude
    return abs(np.mean(found) - expected) / (error / math.sqrt(logs))


def line_error(case, grid, logs, seed):
    """The power of the lines, which is half the squares of their amplitudes: relative deviation of the mean."""
    lines = [part for part in case.parts(grid)[0] if isinstance(part, Line)]
    expected = sum(line.amplitude**2 / 2 for line in lines) + grid.sigma**2
    return abs(np.mean([case.simulate(grid, seed, run)[0][0].var() for run in range(logs)]) / expected - 1)


def flicker_error(grid):
    """The largest relative deviation of the flicker's processes from B²/(2πf), up to rate/4."""
    frequency = np.geomspace(1 / (2 * grid.duration), grid.rate / 4, 2000)
    found = sum(gauss_markov_spectrum(frequency, grid.rate, deviation, keep)
                for keep, deviation in Flicker.processes(grid))
    return np.max(np.abs(found / Flicker(1.0).spectrum(frequency, grid) - 1))


def self_test(grid, seed, say):
    """Compares every case with its theory. Returns the number of failures."""
    failures = 0

    def check(name, what, value, limit):
        nonlocal failures
        failures += value > limit
        say(f"{'FAILED' if value > limit else 'ok    '} {name}: {what} {value:.3g}, limit {limit:g}")

    check("flicker", "relative deviation of the density", flicker_error(grid), 0.04)
    for case in CASES.values():
        parts = [part for axis in case.parts(grid) for part in axis]
        trend = any(isinstance(part, (Trend, Step)) for part in parts)
        if not trend:
            check(case.name, "spectrum, standard errors", spectrum_error(case, grid, 8, seed), 5)
        elif not any(isinstance(part, Walk) for part in parts):
            check(case.name, "trend, standard errors", trend_error(case, grid, 16, seed), 5)
        if any(isinstance(part, Line) for part in parts):
            check(case.name, "power, relative", line_error(case, grid, 4, seed), 0.02)
    return failures

# SPDX-License-Identifier: MIT
"""Static logs whose noise is known, for allan_statistics.py: numpy and scipy only, nothing of the library.

A log is a sum of parts, and what a sensor or a logger then does to it. Densities are two-sided spectral densities of
continuous time, unit²/Hz: white noise N², random walk K²/(2πf)², bias instability (flicker) B²/(2πf), quantization
noise Q²(2πf)². Every part says what its spectrum is, so that self_test() can compare.
"""

import dataclasses
import functools
import math
import zlib

import numpy as np
import scipy.optimize
import scipy.signal
import scipy.stats

WHITE = 1e-3  # N of all cases, unit/√Hz


@dataclasses.dataclass(frozen=True)
class Grid:
    """When a log is sampled."""

    samples: int
    rate: float  # Hz

    @property
    def duration(self):
        return self.samples / self.rate

    @property
    def time(self):
        return np.arange(self.samples) / self.rate

    @property
    def sigma(self):
        """The standard deviation of a sample of the white noise of all cases."""
        return WHITE * math.sqrt(self.rate)


# ------------------------------------------------------------------------------------------------------------- parts


class Part:
    """Something that a log is the sum of. truth: the coefficients that it has, by the library's symbol."""

    truth = {}

    def signal(self, generator, grid):
        raise NotImplementedError

    def spectrum(self, frequency, grid):
        """The spectral density at these frequencies [Hz]: zero of what is not noise."""
        return np.zeros_like(frequency)


class White(Part):
    def __init__(self, density):
        self.density = density
        self.truth = {"N": density}

    def signal(self, generator, grid):
        return self.density * math.sqrt(grid.rate) * generator.standard_normal(grid.samples)

    def spectrum(self, frequency, grid):
        return np.full_like(frequency, self.density**2)


class LowPassedWhite(Part):
    """White noise behind a Butterworth filter of 1 or 2 poles; its density is that below the cutoff [Hz]."""

    def __init__(self, density, poles, cutoff):
        self.density, self.poles, self.cutoff = density, poles, cutoff
        self.truth = {"N": density}

    def signal(self, generator, grid):
        settling = math.ceil(20 * grid.rate / self.cutoff)
        white = generator.standard_normal(grid.samples + settling)
        numerator, denominator = scipy.signal.butter(self.poles, self.cutoff, fs=grid.rate)
        return self.density * math.sqrt(grid.rate) * scipy.signal.lfilter(numerator, denominator, white)[settling:]

    def spectrum(self, frequency, grid):
        # The bilinear transform takes f to tan(πf/rate).
        ratio = np.tan(np.pi * frequency / grid.rate) / math.tan(np.pi * self.cutoff / grid.rate)
        return self.density**2 / (1 + ratio ** (2 * self.poles))


class Walk(Part):
    def __init__(self, density):
        self.density = density
        self.truth = {"K": density}

    def signal(self, generator, grid):
        return self.density / math.sqrt(grid.rate) * np.cumsum(generator.standard_normal(grid.samples))

    def spectrum(self, frequency, grid):
        return (self.density / (2 * grid.rate * np.sin(np.pi * frequency / grid.rate))) ** 2


def gauss_markov(generator, samples, deviation, keep):
    """A stationary first-order process of which a sample keeps the share `keep` of the one before it."""
    fresh = deviation * math.sqrt(1 - keep**2)
    start = [keep * deviation * generator.standard_normal()]
    return scipy.signal.lfilter([fresh], [1, -keep], generator.standard_normal(samples), zi=start)[0]


def gauss_markov_spectrum(frequency, rate, deviation, keep):
    cosine = np.cos(2 * np.pi * frequency / rate)
    return deviation**2 * (1 - keep**2) / (1 - 2 * keep * cosine + keep**2) / rate


class GaussMarkov(Part):
    def __init__(self, deviation, time):
        """Standard deviation and correlation time [s]."""
        self.deviation, self.time = deviation, time
        # Over times shorter than its own it is a walk: where a log cannot tell the two apart, K is that of this walk.
        self.truth = {"sigma": deviation, "tau": time, "K": deviation * math.sqrt(2 / time)}

    def signal(self, generator, grid):
        return gauss_markov(generator, grid.samples, self.deviation, math.exp(-1 / (self.time * grid.rate)))

    def spectrum(self, frequency, grid):
        return gauss_markov_spectrum(frequency, grid.rate, self.deviation, math.exp(-1 / (self.time * grid.rate)))


class Flicker(Part):
    """Bias instability with the density B²/(2πf), f from far below 1/duration up to rate/2.

    A sum of Gauss–Markov processes whose correlation times grow by a factor of 3, from a third of a sample to 100 logs.
    Equal variances of B² ln 3/π would do, since Σ sech(x − k ln 3) is π/ln 3 within 0.1 %, but for what sampling does
    to the fast ones. Their variances are therefore those that make the relative deviation least.
    """

    GROWTH = 3.0

    def __init__(self, coefficient):
        self.coefficient = coefficient
        self.truth = {"B": coefficient}

    @staticmethod
    @functools.lru_cache
    def processes(grid):
        """Of B = 1: the share that a sample keeps of the one before, and the standard deviation, of each process."""
        count = math.ceil(math.log(100 * grid.samples, Flicker.GROWTH))
        kept = [math.exp(-(Flicker.GROWTH**-k)) for k in range(-1, count)]
        frequency = np.geomspace(1 / (4 * grid.duration), grid.rate / 2, 1000)
        shares = [gauss_markov_spectrum(frequency, grid.rate, 1, keep) * 2 * np.pi * frequency for keep in kept]
        variances = scipy.optimize.nnls(np.column_stack(shares), np.ones_like(frequency))[0]
        return [(keep, math.sqrt(variance)) for keep, variance in zip(kept, variances) if variance > 0]

    def signal(self, generator, grid):
        parts = (gauss_markov(generator, grid.samples, self.coefficient * deviation, keep)
                 for keep, deviation in self.processes(grid))
        return sum(parts)

    def spectrum(self, frequency, grid):
        return self.coefficient**2 / (2 * np.pi * frequency)


class Quantization(Part):
    """Differences of white noise of standard deviation Q [unit·s]: the ideal quantization noise of an integral."""

    def __init__(self, coefficient):
        self.coefficient = coefficient
        self.truth = {"Q": coefficient}

    def signal(self, generator, grid):
        return self.coefficient * grid.rate * np.diff(generator.standard_normal(grid.samples + 1))

    def spectrum(self, frequency, grid):
        return (2 * self.coefficient * np.sin(np.pi * frequency / grid.rate)) ** 2 * grid.rate


class Resonance(Part):
    """A second-order resonance that white noise excites: frequency [Hz], Q factor, standard deviation."""

    def __init__(self, frequency, quality, deviation):
        self.frequency, self.quality, self.deviation = frequency, quality, deviation

    def coefficients(self, grid):
        angle = 2 * math.pi * self.frequency / grid.rate
        radius = math.exp(-angle / (2 * self.quality))
        first, second = 2 * radius * math.cos(angle), -(radius**2)
        variance = (1 - second) / ((1 + second) * ((1 - second) ** 2 - first**2))
        return first, second, self.deviation / math.sqrt(variance)

    def signal(self, generator, grid):
        first, second, scale = self.coefficients(grid)
        settling = math.ceil(15 * self.quality / (math.pi * self.frequency) * grid.rate)
        white = generator.standard_normal(grid.samples + settling)
        return scipy.signal.lfilter([scale], [1, -first, -second], white)[settling:]

    def spectrum(self, frequency, grid):
        first, second, scale = self.coefficients(grid)
        turn = np.exp(-2j * np.pi * frequency / grid.rate)
        return scale**2 / np.abs(1 - first * turn - second * turn**2) ** 2 / grid.rate


class Line(Part):
    """A sine of random phase. Its frequency grows by the share `drift` from the beginning to the end."""

    def __init__(self, frequency, amplitude, drift=0.0):
        self.frequency, self.amplitude, self.drift = frequency, amplitude, drift

    def signal(self, generator, grid):
        t = grid.time
        cycles = self.frequency * t * (1 + self.drift * (t / grid.duration - 1) / 2)
        return self.amplitude * np.sin(2 * np.pi * (cycles + generator.uniform()))


class Trend(Part):
    """A shape of time of random sign; `amplitude` times the shape."""

    def __init__(self, amplitude):
        self.amplitude = amplitude

    def shape(self, grid):
        raise NotImplementedError

    def signal(self, generator, grid):
        return self.amplitude * generator.choice([-1, 1]) * self.shape(grid)

    @classmethod
    def error(cls, grid):
        """The standard error of the amplitude by least squares, mean and amplitude fitted, in white noise."""
        shape = cls(1).shape(grid)
        return grid.sigma / math.sqrt(np.sum((shape - shape.mean()) ** 2))


class Ramp(Trend):
    def __init__(self, slope):
        super().__init__(slope)
        self.truth = {"R": slope}

    def shape(self, grid):
        return grid.time


class WarmUp(Trend):
    def __init__(self, height):
        super().__init__(height)
        self.truth = {"W": height, "settling": 600}

    def shape(self, grid):
        return np.exp(-grid.time / 600)


class Step(Part):
    def __init__(self, height):
        self.height = height

    def signal(self, generator, grid):
        time = grid.duration * generator.uniform(0.1, 0.9)
        return np.where(grid.time < time, 0.0, self.height * generator.choice([-1, 1]))


# ----------------------------------------------------------------------------- what a sensor or a logger does to it


def as_it_is(signal, truth, mean, generator, grid):
    return signal, truth


def rounded(step_over_sigma):
    """Rounds samples. Those of white noise stay independent, with a larger variance, which depends on the mean."""

    def apply(signal, truth, mean, generator, grid):
        step = step_over_sigma * grid.sigma
        steps = np.arange(-60, 61) + round(mean / step)
        edges = (np.append(steps - 0.5, steps[-1] + 0.5) * step - mean) / grid.sigma
        probability = np.diff(scipy.stats.norm.cdf(edges))
        values = steps * step
        variance = probability @ values**2 - (probability @ values) ** 2
        return step * np.round(signal / step), {**truth, "N": math.sqrt(variance / grid.rate)}

    return apply


def integral_rounded(step_over_sigma):
    """Rounds the integral, as a sensor that counts pulses does; the step is in units of what the integral of white
    noise gains in a sample. Up to 2 units the rounding errors are independent within 1 %: quantization noise."""

    def apply(signal, truth, mean, generator, grid):
        step = step_over_sigma * grid.sigma / grid.rate
        integral = np.cumsum(np.insert(signal, 0, 0.0) / grid.rate) + step * generator.uniform()
        return grid.rate * np.diff(step * np.round(integral / step)), {**truth, "Q": step / math.sqrt(12)}

    return apply


def with_missing(share):
    """Leaves out samples at random."""

    def apply(signal, truth, mean, generator, grid):
        missing = generator.choice(grid.samples, round(share * grid.samples), replace=False)
        return np.delete(signal, missing), truth

    return apply


# ------------------------------------------------------------------------------------------------------------- cases


@dataclasses.dataclass(frozen=True)
class Case:
    """A kind of log. `parts` gives, for a grid, the parts of every axis."""

    name: str
    parts: object
    finish: object = as_it_is

    def axes(self, grid):
        return len(self.parts(grid))

    def simulate(self, grid, seed, run):
        """The signals of one log, one a row, and what is true of them together: the root mean square of the axes."""
        generator = np.random.default_rng([seed, zlib.crc32(self.name.encode()), run])
        signals, truths = [], []
        for parts in self.parts(grid):
            mean = 10 * grid.sigma * generator.uniform(-1, 1)
            signal = np.full(grid.samples, mean)
            truth = {}
            for part in parts:
                signal += part.signal(generator, grid)
                truth |= part.truth
            signal, truth = self.finish(signal, truth, mean, generator, grid)
            signals.append(signal)
            truths.append(truth)
        symbols = {symbol for truth in truths for symbol in truth}
        together = {s: math.sqrt(np.mean([truth.get(s, 0.0) ** 2 for truth in truths])) for s in sorted(symbols)}
        return np.array(signals), together


def one_axis(name, *parts, finish=as_it_is):
    """A case of one axis with white noise; a part may be a function of the grid."""
    return Case(name, lambda grid: [[part(grid) if callable(part) else part for part in (White(WHITE), *parts)]],
                finish)


def walk(error):
    """The random walk that is known with this relative standard error, √(2/(K·duration/N − 2))."""
    return lambda grid: Walk((2 + 2 / error**2) * WHITE / grid.duration)


def make_cases():
    cases = [one_axis("white")]
    for percent in (35, 15, 5):
        cases.append(one_axis(f"walk_{percent}%", walk(percent / 100)))
    for corner in (0.002, 0.02, 0.2):
        cases.append(one_axis(f"flicker_{corner:g}Hz", Flicker(WHITE * math.sqrt(2 * math.pi * corner))))
    for peak in (3, 30):
        for tau in (10, 100, 600):
            bias = GaussMarkov(WHITE * math.sqrt(peak / (2 * tau)), tau)  # its density at f = 0: 2τσ² = peak·N²
            cases.append(one_axis(f"gauss_markov_{tau}s_x{peak}", bias))
    for z in (3, 10, 30):
        cases.append(one_axis(f"ramp_z{z}", lambda grid, z=z: Ramp(z * Ramp.error(grid))))
    for z in (3, 10):
        # Of K, the slope between the ends has the standard error K/√duration.
        cases.append(one_axis(f"ramp_z{z}_walk", walk(0.15), lambda grid, z=z: Ramp(
            z * walk(0.15)(grid).density / math.sqrt(grid.duration))))
    for z in (5, 20, 100):
        cases.append(one_axis(f"warm_up_z{z}", lambda grid, z=z: WarmUp(z * WarmUp.error(grid))))
    cases.append(one_axis("warm_up_z20_walk", walk(0.15), lambda grid: WarmUp(20 * WarmUp.error(grid))))
    for frequency in (0.05, 0.3, 1, 5, 20, 40):
        for amplitude in (0.5, 3):
            cases.append(one_axis(f"line_{frequency:g}Hz_{amplitude:g}sigma", lambda grid, f=frequency, a=amplitude:
                                  Line(f, a * grid.sigma)))
    for frequency in (1, 20):
        cases.append(one_axis(f"line_{frequency:g}Hz_drifting", lambda grid, f=frequency:
                              Line(f, 3 * grid.sigma, 5e-3)))
    cases.append(one_axis("comb_5Hz", *(lambda grid, k=k: Line(5.01 * k, 2 * grid.sigma / k) for k in range(1, 9))))
    for frequency in (0.1, 0.6, 5, 20):
        cases.append(one_axis(f"resonance_{frequency:g}Hz", lambda grid, f=frequency: Resonance(f, 10, grid.sigma / 2)))
    for step in (0.3, 1, 2, 4):
        cases.append(one_axis(f"rounded_{step:g}sigma", finish=rounded(step)))
    for share in (0.3, 3):
        cases.append(one_axis(f"quantization_{share:g}sigma", lambda grid, s=share: Quantization(
            s * grid.sigma / grid.rate)))
    for step in (1, 2):
        cases.append(one_axis(f"integral_rounded_{step:g}sigma", finish=integral_rounded(step)))
    for poles in (1, 2):
        for part in (10, 4):
            cases.append(Case(f"lowpass_{poles}pole_rate/{part}", lambda grid, poles=poles, part=part: [
                [LowPassedWhite(WHITE, poles, grid.rate / part)]]))
    for height in (0.5, 1, 5):
        cases.append(one_axis(f"step_{height:g}sigma", lambda grid, h=height: Step(h * grid.sigma)))
    cases.append(one_axis("missing_walk_15%", walk(0.15), finish=with_missing(5e-4)))
    cases.append(Case("axes_alike_walk_15%", lambda grid: [[White(WHITE), walk(0.15)(grid)] for _ in range(3)]))
    cases.append(Case("axes_1_to_4", lambda grid: [[White(WHITE * ratio)] for ratio in (1, 4, 1.5)]))
    return cases


CASES = {case.name: case for case in make_cases()}


# --------------------------------------------------------------------------------------------------------- self-test


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

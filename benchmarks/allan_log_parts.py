# SPDX-License-Identifier: MIT
"""The parts of the logs of allan_logs.py: noise, lines and trends, each with its theoretical spectrum."""
import dataclasses
import functools
import math

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

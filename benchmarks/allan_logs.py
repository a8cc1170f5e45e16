# SPDX-License-Identifier: MIT
"""Static logs whose noise is known, for allan_statistics.py: numpy and scipy only, nothing of the library.

A log is a sum of parts, and what a sensor or a logger then does to it. Densities are two-sided spectral densities of
continuous time, unit²/Hz: white noise N², random walk K²/(2πf)², bias instability (flicker) B²/(2πf), quantization
noise Q²(2πf)². Every part says what its spectrum is, so that self_test() can compare.
"""

import dataclasses
import math
import zlib

import numpy as np
import scipy.optimize
import scipy.signal
import scipy.stats

from allan_log_parts import (WHITE, Flicker, GaussMarkov, Line, LowPassedWhite, Quantization, Ramp, Resonance, Step,
                             Walk, WarmUp, White)


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

# SPDX-License-Identifier: MIT
"""The text of the page, with fields for what is measured."""

PAGE_HEAD = """# Speed and accuracy: what to choose

This page measures every choice that trades accuracy for speed, on one machine. [In short](#in-short) has the
recommendations. A program makes the whole page with its tables and plots:

    cmake --workflow --preset bench
    benchmarks/study.py build/bench --data GROUNDTRUTH      # needs numpy and matplotlib

It took {minutes} minutes ({parts}).
The numbers behind the plots are in [study/](study/).

| | |
|---|---|
| processor | {processor}; one of {cores} cores used; {caches} |
| compiler | {compiler}, `{flags}` |
| measured | {date}, load {load_before} at the beginning, on a shared machine |

Times are CPU time. Every kernel is measured {repetitions} times for some milliseconds, alternating with those that it
is compared
with. Tables have the smallest time and, in brackets, the median and the largest. Compare the smallest, because the
machine is shared. Errors are exactly reproducible with the same compiler.
"""

CHOICES = """## In short

{table}

These are the cheapest choices that are good enough. Good enough means that the error is negligible beside the noise of
an industrial-grade MEMS IMU (ADIS16448: {gyro} rad/s and {accel} m/s² in a sample of three axes at 200 Hz). For curves
the limit is a tenth of this noise, in RMS, and the knots are as far apart as it allows. For integrators the limit is a
tenth of the position error over 10 s that the noise causes.

The wheeled robot of this study carries an IMU and is shaken by the floor, so it needs a pose in space. For planar
motion without an IMU use `SE2`, which this study does not measure ([which group](splines.md#which-group)).
"""

REPRESENTATION = """## Curves: group, order, knots, scalar

The scenes are sums of sines. [scenes.hpp](../benchmarks/study/scenes.hpp) has their amplitudes and frequencies.

| scene | what it is |
|---|---|
| hand-held | swings of 0.3 to 1.7 Hz, up to 3 rad/s; tremor at 8 to 9 Hz, 0.1 mm and 1 mrad |
| drone | turns at 0.4 to 1.6 Hz, several g, up to 10 rad/s; corrections at 4 Hz, shaking at 13 to 15 Hz, 0.05 mm and \
3 mrad |
| wheeled robot | an eight of 12 m × 6 m in 25 s; the floor at 2 Hz, 2 mm, and at 11 to 13 Hz, 0.02 mm and 0.3 mrad |
{measured}
A curve is fitted to exact poses of the scene with `fit()` in double, at 100 Hz or five poses per knot interval,
whichever is more. 12.5 s of it are compared with the scene. Since the poses are exact, the error is what the curve
cannot follow.

![Error of the specific force against time a sample](study/representation_pareto_accel.svg)

![Error of the angular velocity against time a sample](study/representation_pareto_gyro.svg)

Each line is the Pareto front of the curves with the same knots. The figures are orders, for SO(3) × R³ in double.

![Error of the specific force against knot interval](study/representation_knots_accel.svg)

![Error of the angular velocity against knot interval](study/representation_knots_gyro.svg)

### Knots come first

The smallest order for which f and ω are good enough, in double on {group}, for each knot interval (— is none):

{orders}

- **Knots must be closer than half a period of the fastest relevant motion.** With knots further apart all orders are
  equally wrong, because faster oscillations are smoothed away. Tremor of 9 Hz needs knots well below 0.05 s.
- **Below that, each halving of the interval divides the error of f by 2 to the power of order − 2,** and that of ω by 2
  to the power of order − 1. For f that is 4 for the cubic and 16 for order 6. So higher orders pay off once knots are
  close enough. Rotations about changing axes gain less from order 6 on, because they do not commute (hand-held, order
  8, last halving: ω by {last_halving} instead of 128).
- **Order 4 is the minimum for an accelerometer.** With order 3 the acceleration jumps, and the table below shows the
  error.
- **Close knots are cheap to evaluate but costly otherwise.** Halving the interval doubles the memory and the time of a
  fit. Knots closer than two or three poses of your data follow their noise. Each higher order costs {per_order}, and
  no memory.
- A curve fitted to a measured trajectory has lost everything above half the rate of the knots, whatever its order.

### What it costs

The table has ns per IMU sample over all scenes and knots (1 kHz for `sample_imu()`), instructions counted with AVX2
(-march=x86-64-v3), and the time of `g++ -O2 -c` for ten lines that evaluate one sample:

{cost}
### SO(3) × R³ or SE(3)

Use SO(3) × R³ unless you need a property of SE(3). The table has the errors in double, RMS (largest), with the
recommended knots of each scene; for the measured flight these are 0.0125 s:

{errors}

- **The angular velocity is identical,** because both represent rotations in the same way.
- **SE(3) has a larger error of f:** at order 6 by the factors
  {ratios}. It takes {time_ratio} times as long one by one. Its acceleration contains the angular velocity. If a
  body turns fast and independently of its path, this only adds error.
- Use SE(3) if the curve must be the same for every point of the body that the pose may refer to
  ([splines](splines.md)).

### float, double or long double

Use double. The table has the RMS error of f [m/s²] for order 6 on SO(3) × R³ and the wheeled robot, which is up to 7 m
from the origin; knots in s:

{scalars}

- **float is sufficient for knots down to 0.025 s** within some metres of the origin. The rounding of a position is
  divided by the interval squared, which is about 6e-8·|p|/interval² in f. With closer knots, or far from the origin,
  this error grows.
- float takes {float_single} of the time of double one by one, and {float_dense} in `sample_imu()`.
- **long double gains nothing here.** The control points were fitted in double, so more digits in the evaluation change
  nothing visible. It takes {long_single} times as long one by one, and {long_dense} times in `sample_imu()`, since no
  vector
  unit supports it. Use it for checks.
"""

INTEGRATORS = """## Integrators

Use `Midpoint` for slow motion or high rates, `RungeKutta4DoubleStep` for fast motion at low rates, and
`TwoSampleIncrements` if the IMU delivers increments.

The error is the RMS position error over 10 s from the true initial state. Without noise it is the scheme's own error;
with noise all good schemes are equally wrong. There are 20 runs of each grade:
{grades}.

![Error against time a sample](study/integrators_pareto.svg)

![Error against rate](study/integrators_rates.svg)

The next table has the cheapest scheme whose own error is at most a tenth of the error that the noise of that grade
causes. The first name is for point samples, the one in brackets for increments, which an IMU delivers if it integrates
internally. A better scheme gains nothing; — means that no scheme is good enough.

{cheapest}

The cost of each scheme, and its own error at {rate:g} Hz:

{cost}

- **Euler saves {euler_saves} ns per sample over the midpoint rule, but its error is {euler_worse} times as large** at
  {rate:g} Hz. The
  zero-order hold saves nothing.
- **`{fourth}` is the order-4 scheme to use for point samples.** It spans two intervals at once.
  `RungeKutta4` on single intervals must interpolate between samples and stays at order 2.
- **An IMU with increments is an advantage.** `TwoSampleIncrements` is more accurate than every scheme on point samples,
  and as cheap as the midpoint rule.
- **A better scheme is cheaper than a higher rate.** Twice the rate means twice the samples, and divides the error of
  the midpoint rule by 4.
- By its data sheet the consumer part has less white noise than the industrial one. The advantage of the industrial part
  is its bias, which is left out here because an estimator removes it.
"""

ERROR_TERMS = """## Error terms

The table has ns per sample of both sensors beyond the empty model, which takes {empty}. Each term is on all axes of
both
sensors unless the table says otherwise.

![Time of error terms](study/error_terms.svg)

{table}

- **Biases, scale factor, rate ramp and g-sensitivity are free;** misalignment and saturation are almost free. Noise
  dominates the cost: six normal numbers take about {white} ns.
- **Terms with a function or many random numbers are expensive:** sinusoidal vibration (a reproducible sine per axis),
  bias instability (7 normal numbers per axis), the temperature terms (an exponential per sensor). If the log is short,
  leave out bias instability, or use Gauss–Markov.
"""

ALLAN = """## Allan deviations

For N and K use the overlapping deviation on octaves or 1-2-5; use `identify()` to find which terms exist.

The logs last an hour and contain white noise and a random walk, at 200 Hz and as averages over 4 s. The next two tables
have the time for a whole curve, ns per sample, smallest:

{costs}

Accuracy of the estimates of N (white noise) and K (random walk) from simulated logs, by `fit_curve()` from such a curve
and by `identify()` from the log itself. Errors are relative, RMS. The fraction of one-sigma intervals that contain the
truth should be 0.68.

![Error of N and K against time](study/allan.svg)

{estimates}

- **The overlapping deviation on octaves or 1-2-5 is enough for N and K,** in {short} to {long} ms. The non-overlapping
  deviation is no cheaper on a long log.
- **More averaging times make the estimates worse, not better:** neighbouring points carry the same information, and the
  fit counts it twice.
- **`identify()` takes {dearer} times as long** as 1-2-5 on a long log, with the same accuracy. Only it finds which of
  the
  terms exist ([allan.md](allan.md)).
- The modified deviation costs three to four times as much on a long log.
"""

COMPILING = """## What it costs to compile

`{compiler} -O2 -c`, CPU seconds of {repetitions} runs: smallest (median, largest), and peak memory:

{table}
"""

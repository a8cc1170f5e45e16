#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what `fitting --study` has written, and prints its table: ways to put a spline along a real trajectory,
beside the IMU that flew along, if there is one.

    fitting_plot.py STUDY.csv [--imu IMU] [--around SECONDS] [-o docs/fitting.svg]

IMU: lines of `ns gx gy gz ax ay az`, separated by commas or blanks. What is compared with it is below 10 Hz (rates) and
2 Hz (specific force), after the mean, which is its bias, is taken away: above, vibrations and noise dominate."""

import argparse

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import thin_svg

WAYS = {"control_points": ("poses as control points", "C1"), "fit": ("least squares (Huber)", "C0"),
        "inertial": ("least squares with the IMU", "C2"), "interpolation": ("through every pose", "C3")}


def low_pass(signal, interval, cutoff):
    spectrum = np.fft.rfft(signal - signal.mean(axis=0), axis=0)
    spectrum[np.fft.rfftfreq(len(signal), interval) > cutoff] = 0
    return np.fft.irfft(spectrum, len(signal), axis=0)


def rms(x):
    return np.sqrt(np.mean(np.square(x)))


def read_imu(path, times):
    with open(path) as file:
        rows = [line.replace(",", " ").split()[:7] for line in file if line.strip() and not line.startswith("#")]
    stamps = np.array([int(row[0]) for row in rows])
    values = np.array([[float(x) for x in row[1:]] for row in rows])
    return np.column_stack([np.interp(times.astype(float) - stamps[0], (stamps - stamps[0]).astype(float), values[:, i])
                            for i in range(6)])


class Study:
    """The columns of the study, for each way: distances from the poses, accelerations, rates and specific forces."""

    def __init__(self, path, imu):
        data = np.genfromtxt(path, delimiter=",", names=True, dtype=None)
        self.ways = {way: look for way, look in WAYS.items() if f"{way}_dx_m" in data.dtype.names}
        stamps = data["time_ns"]
        self.t = (stamps - stamps[0]) * 1e-9
        self.interval = np.median(np.diff(self.t))

        def columns(letters):
            return {way: np.column_stack([data[f"{way}_{letter}"] for letter in letters]) for way in self.ways}

        self.off = {way: np.linalg.norm(x, axis=1) for way, x in columns(("dx_m", "dy_m", "dz_m")).items()}
        self.accel = {way: np.linalg.norm(x, axis=1) for way, x in columns(("ax", "ay", "az")).items()}
        self.rates, self.forces = columns(("wx", "wy", "wz")), columns(("fx", "fy", "fz"))
        self.imu = read_imu(imu, stamps) if imu else None


def print_table(study):
    imu = study.imu
    print("| | from the poses: median [mm] | max [mm] | acceleration: RMS [m/s²] | max [m/s²] |"
          + (" gyro − IMU below 10 Hz [rad/s] | accel − IMU below 2 Hz [m/s²] |" if imu is not None else ""))
    print("|---|---|---|---|---|" + ("---|---|" if imu is not None else ""))
    for way, (name, _) in study.ways.items():
        off, accel = study.off[way], study.accel[way]
        row = f"| {name} | {1e3 * np.median(off):.4f} | {1e3 * off.max():.2f} | {rms(accel):.2f} | {accel.max():.1f} |"
        if imu is not None:
            row += f" {rms(low_pass(imu[:, :3] - study.rates[way], study.interval, 10)):.2e}" \
                   f" | {rms(low_pass(imu[:, 3:] - study.forces[way], study.interval, 2)):.3f} |"
        print(row)


def draw_jump(axes, study, jump):
    """Distance from the poses and acceleration, within 0.3 s of the jump."""
    near = np.abs(study.t - jump) < 0.3
    for way, (name, colour) in study.ways.items():
        axes[0].plot(study.t[near], 1e3 * study.off[way][near], color=colour, label=name, linewidth=1.2)
        axes[1].semilogy(study.t[near], np.maximum(study.accel[way][near], 1e-2), color=colour, linewidth=1.2)
    axes[0].set(ylabel="from the poses [mm]", title=f"A jump of the ground truth at {jump:.2f} s")
    axes[0].legend(loc="upper right")
    axes[1].set(ylabel="acceleration [m/s²]", xlabel="time [s]")


def draw_force(axis, study, jump):
    """The specific force beside the accelerometer's, within 4 s of the jump."""
    t, around = study.t, np.abs(study.t - jump) < 4
    for way in [way for way in ("interpolation", "fit", "inertial") if way in study.ways]:
        axis.plot(t[around], study.forces[way][around, 0], color=WAYS[way][1], linewidth=0.9,
                  alpha=0.5 if way == "interpolation" else 1)
    if study.imu is not None:
        measured = study.imu[:, 3]
        bias = (measured - study.forces["fit"][:, 0]).mean()
        smooth = low_pass(study.imu[:, 3:4], study.interval, 10)[:, 0] + measured.mean() - bias
        axis.plot(t[around], smooth[around], "k", linewidth=0.9, label="IMU, below 10 Hz, bias taken away")
        axis.legend(loc="upper right")
        low, high = smooth[around].min(), smooth[around].max()
        axis.set_ylim(low - 0.5 * (high - low), high + 0.5 * (high - low))
    axis.set(ylabel="specific force, x [m/s²]", xlabel="time [s]", title="What an accelerometer would read")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study")
    parser.add_argument("--imu")
    parser.add_argument("--around", type=float, help="time of the detail [s]; default: the largest jump")
    parser.add_argument("-o", "--output", help="svg or png")
    arguments = parser.parse_args()
    study = Study(arguments.study, arguments.imu)
    print_table(study)
    if not arguments.output:
        return
    plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3})
    jump = arguments.around if arguments.around is not None else study.t[np.argmax(study.off["fit"])]
    figure, axes = plt.subplots(3, 1, figsize=(8, 8.5), layout="constrained")
    draw_jump(axes, study, jump)
    draw_force(axes[2], study, jump)
    thin_svg.save(figure, arguments.output)


if __name__ == "__main__":
    main()

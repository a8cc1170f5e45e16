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


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study")
    parser.add_argument("--imu")
    parser.add_argument("--around", type=float, help="time of the detail [s]; default: the largest jump")
    parser.add_argument("-o", "--output", help="svg or png")
    arguments = parser.parse_args()

    data = np.genfromtxt(arguments.study, delimiter=",", names=True, dtype=None)
    ways = {way: look for way, look in WAYS.items() if f"{way}_dx_m" in data.dtype.names}
    stamps = data["time_ns"]
    t = (stamps - stamps[0]) * 1e-9
    interval = np.median(np.diff(t))

    def columns(way, letters):
        return np.column_stack([data[f"{way}_{letter}"] for letter in letters])

    off = {way: np.linalg.norm(columns(way, ("dx_m", "dy_m", "dz_m")), axis=1) for way in ways}
    accel = {way: np.linalg.norm(columns(way, ("ax", "ay", "az")), axis=1) for way in ways}
    rates = {way: columns(way, ("wx", "wy", "wz")) for way in ways}
    forces = {way: columns(way, ("fx", "fy", "fz")) for way in ways}
    imu = read_imu(arguments.imu, stamps) if arguments.imu else None

    print("| | from the poses: median [mm] | max [mm] | acceleration: RMS [m/s²] | max [m/s²] |"
          + (" gyro − IMU below 10 Hz [rad/s] | accel − IMU below 2 Hz [m/s²] |" if imu is not None else ""))
    print("|---|---|---|---|---|" + ("---|---|" if imu is not None else ""))
    for way, (name, _) in ways.items():
        row = f"| {name} | {1e3 * np.median(off[way]):.4f} | {1e3 * off[way].max():.2f} " \
              f"| {rms(accel[way]):.2f} | {accel[way].max():.1f} |"
        if imu is not None:
            row += f" {rms(low_pass(imu[:, :3] - rates[way], interval, 10)):.2e}" \
                   f" | {rms(low_pass(imu[:, 3:] - forces[way], interval, 2)):.3f} |"
        print(row)
    if not arguments.output:
        return

    plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.alpha": 0.3})
    jump = arguments.around if arguments.around is not None else t[np.argmax(off["fit"])]
    figure, axes = plt.subplots(3, 1, figsize=(8, 8.5), layout="constrained")

    near = np.abs(t - jump) < 0.3
    for way, (name, colour) in ways.items():
        axes[0].plot(t[near], 1e3 * off[way][near], color=colour, label=name, linewidth=1.2)
    axes[0].set(ylabel="from the poses [mm]", title=f"A jump of the ground truth at {jump:.2f} s")
    axes[0].legend(loc="upper right")
    for way, (name, colour) in ways.items():
        axes[1].semilogy(t[near], np.maximum(accel[way][near], 1e-2), color=colour, linewidth=1.2)
    axes[1].set(ylabel="acceleration [m/s²]", xlabel="time [s]")

    around = np.abs(t - jump) < 4
    for way in [way for way in ("interpolation", "fit", "inertial") if way in ways]:
        name, colour = WAYS[way]
        axes[2].plot(t[around], forces[way][around, 0], color=colour, linewidth=0.9,
                     alpha=0.5 if way == "interpolation" else 1)
    if imu is not None:
        bias = (imu[:, 3] - forces["fit"][:, 0]).mean()
        smooth = low_pass(imu[:, 3:4], interval, 10)[:, 0] + imu[:, 3].mean() - bias
        axes[2].plot(t[around], smooth[around], "k", linewidth=0.9, label="IMU, below 10 Hz, bias taken away")
        axes[2].legend(loc="upper right")
        low, high = smooth[around].min(), smooth[around].max()
        axes[2].set_ylim(low - 0.5 * (high - low), high + 0.5 * (high - low))
    axes[2].set(ylabel="specific force, x [m/s²]", xlabel="time [s]", title="What an accelerometer would read")
    thin_svg.save(figure, arguments.output)


if __name__ == "__main__":
    main()

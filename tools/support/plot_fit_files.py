# SPDX-License-Identifier: MIT
"""Reads the files of fit_trajectory that plot_fit.py draws."""
import os
import re

from plotting import Failure

RESIDUALS = ("#timestamp [ns],rotation_x [rad],rotation_y [rad],rotation_z [rad],position_x [m],position_y [m],"
             "position_z [m],outlier")
GAPS = "#start [ns],end [ns],length [s]"
DERIVED = ("#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],a_RS_S_x [m s^-2],"
           "a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]")
SAMPLES = ("#timestamp [ns],gyro_x [rad/s],gyro_y [rad/s],gyro_z [rad/s],accel_x [m/s^2],accel_y [m/s^2],"
           "accel_z [m/s^2],gyro_residual_x [rad/s],gyro_residual_y [rad/s],gyro_residual_z [rad/s],"
           "accel_residual_x [m/s^2],accel_residual_y [m/s^2],accel_residual_z [m/s^2],invented")


def read(path, header):
    """The times [ns], as integers, and the rows, as numbers."""
    times, rows, number = [], [], 0
    with open(path, encoding="utf-8", errors="replace") as file:
        for number, line in enumerate(file, 1):
            line = line.rstrip("\n")
            if number == 1:
                if line != header:
                    raise Failure(f"{path}:1: {line[:60]!r}, expected the header {header}")
                continue
            if line.startswith("#"):
                continue
            fields = line.split(",")
            if len(fields) != header.count(",") + 1:
                raise Failure(f"{path}:{number}: {len(fields)} columns, expected {header.count(',') + 1}: {header[1:]}")
            try:
                times.append(int(fields[0]))
                rows.append([float(field) for field in fields[1:]])
            except ValueError:
                raise Failure(f"{path}:{number}: {line[:60]!r}, expected numbers") from None
    if number == 0:
        raise Failure(f"{path}: empty, expected the header {header}")
    return times, rows


def seconds(times, start):
    import numpy
    return numpy.array([time - start for time in times], dtype=float) * 1e-9


def knot_interval(folder):
    """The interval of uniform knots, s; the median length of the segments of others."""
    import numpy
    header = (folder / "control_points.csv").read_text(encoding="utf-8", errors="replace")[:2000]
    found = re.search(r"^# interval \[ns\]: (\d+)$", header, re.MULTILINE)
    if found:
        return int(found[1]) * 1e-9
    knots, _ = read(folder / "knots.csv", "#knot [ns]")
    lengths = numpy.diff(numpy.array([knot - knots[0] for knot in knots], dtype=float)) * 1e-9
    return float(numpy.median(lengths[lengths > 0])) if (lengths > 0).any() else 0.05


def title_of(folder):
    """A title from the lines of report.txt on poses, spline and knots."""
    try:
        lines = (folder / "report.txt").read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return ""
    place = next((i for i, line in enumerate(lines) if line.startswith("spline: ")), 0)
    if not 0 < place < len(lines) - 1:
        return ""
    name = os.path.basename(lines[place - 1].split(": ")[0])
    spline = lines[place].removeprefix("spline: ").replace("R^3", "R³").replace(" x ", " × ")
    return f"{name}:  spline of {spline}, {re.split(', the | [(]', lines[place + 1])[0]}"


def read_samples(path, header, start):
    """The times, s from `start`, and the columns of a file."""
    import numpy
    times, rows = read(path, header)
    return seconds(times, start), numpy.array(rows)


def read_imu(folder, start):
    """The samples of imu_residuals.csv; nothing if there are fewer than two."""
    path = folder / "imu_residuals.csv"
    if not path.exists():
        return None
    samples = read_samples(path, SAMPLES, start)
    return samples if len(samples[0]) > 1 else None


def read_gaps(folder, start):
    starts, rows = read(folder / "gaps.csv", GAPS)
    return list(zip(seconds(starts, start), seconds([int(row[0]) for row in rows], start)))


def gaps_between_poses(time, gaps, interval):
    """Gaps of more than two knot intervals besides these, whether or not neighbouring poses determine the curve
    there."""
    import numpy
    sparse = numpy.flatnonzero(numpy.diff(time) > 2 * interval)
    return [(time[i], time[i + 1]) for i in sparse
            if not any(begin < time[i + 1] and end > time[i] for begin, end in gaps)]

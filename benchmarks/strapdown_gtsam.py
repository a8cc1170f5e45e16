#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""GTSAM's preintegration on the samples of the benchmark program strapdown. Needs the Python package gtsam.

    strapdown --write-samples FOLDER                     # 100.csv, 200.csv, ...: t, gyro, accel, position, velocity, q
    strapdown_gtsam.py FOLDER                            # name,value,unit

Each interval is given the mean of its two samples, and preintegration begins anew every 0.1 s, as between key frames.
The time is that of Python's loop, which is most of it."""
import csv
import pathlib
import sys
import time


def main():
    if len(sys.argv) != 2 or sys.argv[1] in ("-h", "--help"):
        print(__doc__)
        sys.exit(0 if len(sys.argv) == 2 else 2)
    try:
        import gtsam
        import numpy
    except ImportError:
        sys.exit("strapdown_gtsam.py: the Python package gtsam is not installed")
    parameters = gtsam.PreintegrationParams.MakeSharedU(9.80665)
    bias = gtsam.imuBias.ConstantBias()
    for path in sorted(pathlib.Path(sys.argv[1]).glob("*.csv"), key=lambda p: float(p.stem)):
        with open(path, newline="") as file:
            rows = [[float(x) for x in row] for row in csv.reader(file)]
        rows = numpy.array(rows)
        t, gyro, accel, p, v, q = rows[:, 0], rows[:, 1:4], rows[:, 4:7], rows[:, 7:10], rows[:, 10:13], rows[:, 13:17]
        initial = gtsam.NavState(gtsam.Rot3.Quaternion(*q[0]), p[0], v[0])
        measured = gtsam.PreintegratedImuMeasurements(parameters, bias)
        error = 0.0
        spent = 0.0
        for i in range(len(t) - 1):
            dt = t[i + 1] - t[i]
            mean_accel, mean_gyro = (accel[i] + accel[i + 1]) / 2, (gyro[i] + gyro[i + 1]) / 2
            start = time.perf_counter()
            measured.integrateMeasurement(mean_accel, mean_gyro, dt)
            spent += time.perf_counter() - start
            state = measured.predict(initial, bias)
            if measured.deltaTij() > 0.1 - dt / 2:
                initial = state
                measured.resetIntegration()
            error = max(error, numpy.linalg.norm(state.position() - p[i + 1]))
        print(f"error_gtsam_{path.stem}_Hz,{error:.4g},m")
        print(f"ns_gtsam_python_{path.stem}_Hz,{spent / (len(t) - 1) * 1e9:.0f},ns")


if __name__ == "__main__":
    main()

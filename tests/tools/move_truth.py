"""Moves the truth of an IMU to a body that carries it: with the lever arm l = (0.3 -0.2 0.1) m, the axes R_BI of the
quaternion (1 2 2 4)/5, and a clock that is 12.5 ms ahead. The file of states loses its biases.

    move_truth.py IMU_CSV GROUNDTRUTH_CSV STATES_CSV POSES_TUM
"""

import sys


def product(a, b):
    (w, x, y, z), (W, X, Y, Z) = a, b
    return (w * W - x * X - y * Y - z * Z, w * X + x * W + y * Z - z * Y, w * Y - x * Z + y * W + z * X,
            w * Z + x * Y - y * X + z * W)


def inverse(q):
    return (q[0], -q[1], -q[2], -q[3])


def rotated(q, v):
    return product(product(q, (0, *v)), inverse(q))[1:]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def rows(path):
    return [line.strip().split(",") for line in open(path) if not line.startswith("#")]


BIAS = 0.01  # rad/s on each axis of the gyro
q_BI, l = (0.2, 0.4, 0.4, 0.8), (0.3, -0.2, 0.1)
imu, truth, states, poses = sys.argv[1:]
gyro = {row[0]: [float(v) - BIAS for v in row[1:4]] for row in rows(imu)}
with open(states, "w") as states, open(poses, "w") as poses:
    for stamp, *numbers in rows(truth):
        numbers = list(map(float, numbers))
        p, q, v = numbers[:3], numbers[3:7], numbers[7:10]
        q = product(q, inverse(q_BI))
        p = [a - b for a, b in zip(p, rotated(q, l))]
        v = [a - b for a, b in zip(v, rotated(q, cross(rotated(q_BI, gyro[stamp]), l)))]
        time = int(stamp) + 12_500_000
        print(time, *map(repr, (*p, *q, *v)), *["0"] * 6, sep=",", file=states)
        print(f"{time // 10**9}.{time % 10**9:09d}", *map(repr, (*p, *q[1:], q[0])), file=poses)

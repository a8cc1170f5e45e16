# SPDX-License-Identifier: MIT
"""Reads the files that allan writes for estimators as these do: Kalibr with PyYAML, OpenVINS, VINS and ORB-SLAM3 with
OpenCV's FileStorage where Python has it.

    imu_noise_check.py FOLDER

Exit code 77: PyYAML is not installed, nothing was checked.
"""
import math
import pathlib
import sys

try:
    import yaml
except ImportError:
    print("skipped: the Python package yaml is not installed (pip install PyYAML)")
    sys.exit(77)
try:
    import cv2
except ImportError:
    cv2 = None
    print("skipped: FileStorage, because the Python package cv2 is not installed (pip install opencv-python-headless)")

folder = pathlib.Path(sys.argv[1])
KALIBR = ["gyroscope_noise_density", "gyroscope_random_walk", "accelerometer_noise_density", "accelerometer_random_walk"]


def expect(condition, *what):
    if not condition:
        print("FAILED:", *what)
        sys.exit(1)


def entries(name):
    text = (folder / name).read_text(encoding="utf-8")
    if text.startswith("%YAML:1.0\n"):  # OpenCV's way to write the directive
        text = text.split("\n", 1)[1]
    content = yaml.safe_load(text)
    return content.get("imu0", content)


def expect_numbers(name, keys, expected, to_density):
    found = entries(name)
    for key, density in zip(keys, expected):
        expect(isinstance(found[key], float), name, key, found[key], "is no number to YAML 1.1")
        expect(math.isclose(to_density(found[key]), density, rel_tol=1e-14), name, key, found[key], density)
    if cv2 and name not in ("imu.yaml", "gtsam_imu.yaml"):
        storage = cv2.FileStorage(str(folder / name), cv2.FILE_STORAGE_READ)
        root = storage.getNode("imu0") if name == "openvins_imu.yaml" else storage
        for key in keys:
            node = root.getNode(key)
            expect(node.isReal() and node.real() == found[key], name, key, node.real(), found[key], "to FileStorage")


kalibr = entries("imu.yaml")
expected = [kalibr[key] for key in KALIBR]
expect(all(isinstance(value, float) and value > 0 for value in expected), "imu.yaml:", kalibr)
rate = kalibr["update_rate"]
expect_numbers("openvins_imu.yaml", KALIBR, expected, lambda value: value)
expect_numbers("vins_imu.yaml", ["gyr_n", "gyr_w", "acc_n", "acc_w"], expected, lambda value: value / math.sqrt(rate))
expect_numbers("orbslam3_imu.yaml", ["IMU.NoiseGyro", "IMU.GyroWalk", "IMU.NoiseAcc", "IMU.AccWalk"], expected, lambda value: value)
expect_numbers("gtsam_imu.yaml", ["gyroscopeCovariance", "biasOmegaCovariance", "accelerometerCovariance", "biasAccCovariance"],
               expected, math.sqrt)
openvins = entries("openvins_imu.yaml")
expect(openvins["T_i_b"] == [[float(i == j) for j in range(4)] for i in range(4)], openvins)
for key in "Tw", "R_IMUtoGYRO", "Ta", "R_IMUtoACC":
    expect(openvins[key] == [[float(i == j) for j in range(3)] for i in range(3)], key, openvins)
expect(openvins["Tg"] == [[0.0] * 3] * 3, openvins)
print("the files for estimators have the same noise")

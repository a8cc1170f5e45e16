# SPDX-License-Identifier: MIT
"""Writes bags with pose topics by rosbags' own serialiser, reads them with tools/support/pose_bag.py and, where it is
given, with the program simulate_imu; and looks at what both say to bad input.

    pose_bag_check.py WORK_DIR [SIMULATE_IMU]

Exit code 77: rosbags is not installed, nothing was checked.
"""

import math
import pathlib
import shutil
import subprocess
import sys

try:
    import numpy
    import rosbags.rosbag1
    import rosbags.rosbag2
    from rosbags.typesys import Stores, get_typestore
except ImportError as error:
    print(f"skipped: the Python package {error.name} is not installed (pip install rosbags)")
    sys.exit(77)

work = pathlib.Path(sys.argv[1])
script = pathlib.Path(__file__).resolve().parents[2] / "tools/support/pose_bag.py"
simulate_imu = sys.argv[2] if len(sys.argv) > 2 else None
shutil.rmtree(work, ignore_errors=True)
work.mkdir(parents=True)


def expect(condition, *what):
    if not condition:
        print("FAILED:", *what)
        sys.exit(1)


def run(*arguments):
    return subprocess.run(list(map(str, arguments)), capture_output=True, text=True)


def poses():
    """Stamps that a double cannot hold, and a smooth motion."""
    for i in range(200):
        t = i / 100
        half = 0.2 * math.sin(t)
        yield 1403636579758555392 + 10_000_001 * i, (math.sin(t), math.cos(t), 0.1 * t), (0.0, 0.0, math.sin(half), math.cos(half))


def make_message(types, ros1, kind, stamp, p, q):
    make = types.types
    time = make["builtin_interfaces/msg/Time"](sec=stamp // 10**9, nanosec=stamp % 10**9)
    fields = {"stamp": time, "frame_id": "a world"}
    if ros1:
        fields["seq"] = 7
    header = make["std_msgs/msg/Header"](**fields)
    quaternion = make["geometry_msgs/msg/Quaternion"](*q)
    pose = make["geometry_msgs/msg/Pose"](make["geometry_msgs/msg/Point"](*p), quaternion)
    covariance = numpy.zeros(36)
    if kind == "geometry_msgs/msg/PoseStamped":
        return make[kind](header, pose)
    if kind == "geometry_msgs/msg/TransformStamped":
        transform = make["geometry_msgs/msg/Transform"](make["geometry_msgs/msg/Vector3"](*p), quaternion)
        return make[kind](header, "body", transform)
    with_covariance = make["geometry_msgs/msg/PoseWithCovariance"](pose, covariance)
    if kind == "geometry_msgs/msg/PoseWithCovarianceStamped":
        return make[kind](header, with_covariance)
    zero = make["geometry_msgs/msg/Vector3"](1.0, 2.0, 3.0)
    twist = make["geometry_msgs/msg/TwistWithCovariance"](make["geometry_msgs/msg/Twist"](zero, zero), covariance)
    return make[kind](header, "body", with_covariance, twist)


KINDS = {"/odometry": "nav_msgs/msg/Odometry", "/pose": "geometry_msgs/msg/PoseStamped",
         "/pose_cov": "geometry_msgs/msg/PoseWithCovarianceStamped", "/transform": "geometry_msgs/msg/TransformStamped"}


def write_bag(path, topics, lines, ros1):
    types = get_typestore(Stores.ROS1_NOETIC if ros1 else Stores.ROS2_HUMBLE)
    storage = rosbags.rosbag2.StoragePlugin
    writer = (rosbags.rosbag1.Writer(path) if ros1 else
              rosbags.rosbag2.Writer(path, version=8, storage_plugin=storage.MCAP))
    encode = types.serialize_ros1 if ros1 else types.serialize_cdr
    with writer:
        connections = {topic: writer.add_connection(topic, KINDS[topic], typestore=types) for topic in topics}
        noise = writer.add_connection("/clock_text", "std_msgs/msg/String", typestore=types)
        text = types.types["std_msgs/msg/String"]("hello")
        for arrival, (stamp, p, q) in enumerate(lines):
            writer.write(noise, 10**18 + arrival, encode(text, "std_msgs/msg/String"))
            for topic, connection in connections.items():
                message = make_message(types, ros1, KINDS[topic], stamp, p, q)
                writer.write(connection, 10**18 + arrival, encode(message, KINDS[topic]))
    return path


def lines_of(text):
    return [(int(line.split(",")[0]), tuple(map(float, line.split(",")[1:]))) for line in text.splitlines()]


truth = [(stamp, p + q) for stamp, p, q in poses()]
for name, ros1 in (("all.bag", True), ("all", False)):
    bag = write_bag(work / name, KINDS, list(poses()), ros1)
    for topic in KINDS:
        result = run(sys.executable, script, bag, "--topic", topic)
        expect(result.returncode == 0 and not result.stderr, bag, topic, result)
        expect(lines_of(result.stdout) == truth, bag, topic, "other poses than were written")
    listed = "expected --topic with one of /odometry, /pose, /pose_cov, /transform"
    for arguments, said in ((), f"several pose topics, {listed}"), (("--topic", "/none"),
                                                                    "no pose topic /none, expected one of /odometry, /pose,"):
        result = run(sys.executable, script, bag, *arguments)
        expect(result.returncode == 2 and said in result.stderr and not result.stdout, bag, arguments, result)
one = write_bag(work / "one.bag", ["/pose"], list(poses()), True)
expect(lines_of(run(sys.executable, script, one).stdout) == truth, "the only topic is taken")
none = write_bag(work / "none.bag", [], list(poses()), True)
result = run(sys.executable, script, none)
expect(result.returncode == 2 and "only /clock_text (std_msgs/msg/String)" in result.stderr, result)

if simulate_imu:
    simulate = [simulate_imu, "--preset", "ideal", "--output", work / "out"]
    result = run(*simulate, work / "all.bag", "--topic", "/odometry")
    expect(result.returncode == 0 and "200 poses over 1.99" in result.stdout, result)
    result = run(*simulate, work / "all", "--topic", "/transform")
    expect(result.returncode == 0 and "200 poses over 1.99" in result.stdout, result)
    result = run(*simulate, work / "all.bag")
    expect(result.returncode == 2 and "several pose topics" in result.stderr, result)
    result = run(*simulate, one, "--format", "tum")
    expect(result.returncode == 2 and "a ROS bag, expected no options except --topic and --skip-bad-rows" in result.stderr, result)
    result = run(*simulate, work / "missing.bag")
    expect(result.returncode == 2 and "no such file or folder" in result.stderr, result)
    wrong = list(poses())
    wrong[5] = (wrong[4][0], *wrong[5][1:])
    bad = write_bag(work / "bad.bag", ["/pose"], wrong, True)
    result = run(*simulate, bad)
    expect(result.returncode == 2 and f"{bad}: message 6: time" in result.stderr and "--skip-bad-rows" in result.stderr, result)
    result = run(*simulate, bad, "--skip-bad-rows")
    expect(result.returncode == 0 and "1 row left out" in result.stdout and "199 poses" in result.stdout, result)
    damaged = work / "damaged.bag"
    damaged.write_bytes(one.read_bytes()[:5000])
    result = run(*simulate, damaged)
    expect(result.returncode == 2 and "damaged" in result.stderr, result)
print("4 types of messages in bags of ROS 1 and ROS 2: the same poses as were written")

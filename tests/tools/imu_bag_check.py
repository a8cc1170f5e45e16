"""Writes bags with tools/support/imu_bag.py, reads them back with it, with rosbags' own deserialiser, and a ROS 1 bag
also with ROS' own module rosbag if /usr/bin/python3 has it; and looks at what it says to bad input.

    imu_bag_check.py WORK_DIR [IMU_BAG]

Exit code 77: rosbags is not installed, nothing was checked.
"""

import pathlib
import random
import shutil
import subprocess
import sys

try:
    import numpy
    import rosbags.highlevel
    import rosbags.rosbag1
    import rosbags.rosbag2
    from rosbags.typesys import Stores, get_typestore
except ImportError as error:
    print(f"skipped: the Python package {error.name} is not installed (pip install rosbags)")
    sys.exit(77)

work = pathlib.Path(sys.argv[1])
root = pathlib.Path(__file__).resolve().parents[2]
program = sys.argv[2] if len(sys.argv) > 2 else root / "tools/support/imu_bag.py"
imu = "sensor_msgs/msg/Imu"
header = ("#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
          "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]\n")


def expect(condition, *what):
    if not condition:
        print("FAILED:", *what)
        sys.exit(1)


def run(*arguments):
    return subprocess.run([sys.executable, "-W", "error::DeprecationWarning:__main__", program, *map(str, arguments)],
                          capture_output=True, text=True)


def ok(*arguments):
    result = run(*arguments)
    expect(result.returncode == 0 and not result.stderr, *arguments, result)
    return result.stdout


def refused(arguments, *says):
    """One line, exit code 2, and nothing new beside the input."""
    before = sorted(work.rglob("*"))
    result = run(*arguments)
    expect(result.returncode == 2, *arguments, result)
    expect(result.stderr.count("\n") == 1 and "Traceback" not in result.stderr, *arguments, result.stderr)
    for text in says:
        expect(text in result.stderr, *arguments, "does not say", repr(text), "but", result.stderr)
    expect(sorted(work.rglob("*")) == before, *arguments, "left something behind")


def make_samples():
    """All sorts of doubles; times that a double could not hold, and one of 0."""
    noise = random.Random(1)
    samples = [(0, (0.0, -0.0, 5e-324, 1.7976931348623157e308, -1e-300, 0.1))]
    time = 1403636579758555392
    for _ in range(500):
        time += noise.randint(1, 10_000_000)
        samples.append((time, tuple(noise.gauss(0, 1) * 10 ** noise.randint(-12, 3) for _ in range(6))))
    return samples


def write_csv(path, samples, first=header):
    path.write_text(first + "".join(f"{time},{','.join(map(repr, values))}\n" for time, values in samples))
    return path


def bits(values):
    return numpy.array(values, float).tobytes()


def check_with_rosbags(path, samples, topic, frame):
    with rosbags.highlevel.AnyReader([path]) as reader:
        read = list(reader.messages())
        expect(len(read) == len(samples), path, len(read), "messages")
        for (time, values), (connection, received, data) in zip(samples, read):
            message = reader.deserialize(data, connection.msgtype)
            stamp = message.header.stamp
            expect((connection.topic, connection.msgtype, message.header.frame_id) == (topic, imu, frame), path, message)
            expect(received == time and stamp.sec * 10**9 + stamp.nanosec == time, path, time, stamp)
            w, a = message.angular_velocity, message.linear_acceleration
            expect(bits([w.x, w.y, w.z, a.x, a.y, a.z]) == bits(values), path, time, message)
            q = message.orientation
            expect((q.x, q.y, q.z, q.w) == (0, 0, 0, 1), path, message)
            expect(list(message.orientation_covariance) == [-1] + [0] * 8, path, message)
            expect(not any(message.angular_velocity_covariance) and not any(message.linear_acceleration_covariance), message)
            # The very bytes that rosbags would have written.
            if reader.is2:
                expect(bytes(reader.typestore.serialize_cdr(message, imu)) == bytes(data), path, time)
            else:
                expect(bytes(reader.typestore.serialize_ros1(message, imu)) == bytes(data), path, time)


def check_with_ros(path, samples):
    python = "/usr/bin/python3"
    try:
        found = subprocess.run([python, "-c", "import rosbag"], capture_output=True).returncode == 0
    except OSError:
        found = False
    if not found:
        print(f"skipped: reading the ROS 1 bag with ROS' own rosbag, which {python} cannot import")
        return
    script = ("import rosbag, sys\n"
              "for topic, m, t in rosbag.Bag(sys.argv[1]).read_messages():\n"
              "    w, a = m.angular_velocity, m.linear_acceleration\n"
              "    assert m._type == 'sensor_msgs/Imu' and m.orientation_covariance[0] == -1\n"
              "    assert t == m.header.stamp and m.header.frame_id == 'imu'\n"
              "    print(t.to_nsec(), topic, *map(repr, (w.x, w.y, w.z, a.x, a.y, a.z)))\n")
    result = subprocess.run([python, "-c", script, path], capture_output=True, text=True)
    expect(result.returncode == 0, "ROS' rosbag:", result.stderr)
    expected = "".join(f"{time} /imu0 {' '.join(map(repr, values))}\n" for time, values in samples)
    expect(result.stdout == expected, "ROS' rosbag reads something else from", path)
    print("ROS' own rosbag reads the same")


def check_foreign_bags(samples):
    """What others write: several topics and frames, compressed, arrival at other times than the headers', big-endian CDR."""
    types = get_typestore(Stores.ROS1_NOETIC)
    Imu, Header, Time = (types.types[name] for name in (imu, "std_msgs/msg/Header", "builtin_interfaces/msg/Time"))
    Vector, Quaternion = types.types["geometry_msgs/msg/Vector3"], types.types["geometry_msgs/msg/Quaternion"]
    String = types.types["std_msgs/msg/String"]

    def message(index, time, values, frame):
        return Imu(Header(index, Time(*divmod(time, 10**9)), frame), Quaternion(0.5, 0.5, -0.5, 0.5), numpy.full(9, 3.0),
                   Vector(*values[:3]), numpy.full(9, 4.0), Vector(*values[3:]), numpy.full(9, 5.0))

    expected = header + "".join(f"{time},{','.join(map(repr, values))}\n" for time, values in samples)
    bag = work / "foreign.bag"
    writer = rosbags.rosbag1.Writer(bag)
    writer.set_compression(writer.CompressionFormat.LZ4)
    with writer:
        a = writer.add_connection("/a/imu", imu, typestore=types)
        b = writer.add_connection("/b/imu", imu, typestore=types)
        text = writer.add_connection("/text", "std_msgs/msg/String", typestore=types)
        for index, (time, values) in enumerate(samples):
            data = types.serialize_ros1(message(index, time, values, "x" * (index % 11)), imu)
            writer.write(a, 10**9 + index * 1000, data)
            writer.write(b, 10**9 + index * 1000, types.serialize_ros1(message(index, time + 1, values, "b"), imu))
            writer.write(text, 10**9 + index * 1000, types.serialize_ros1(String("hello"), "std_msgs/msg/String"))
    expect(ok("to-csv", bag, "-", "--topic", "/a/imu") == expected, bag)
    refused(["to-csv", bag, work / "no.csv"], "foreign.bag", "several", "/a/imu, /b/imu", "--topic")
    refused(["to-csv", bag, work / "no.csv", "--topic", "/c"], "no IMU topic /c", "/a/imu, /b/imu")

    types = get_typestore(Stores.ROS2_HUMBLE)
    Imu, Header = (types.types[name] for name in (imu, "std_msgs/msg/Header"))
    original, Header = Header, lambda index, stamp, frame: original(stamp, frame)
    for little_endian in True, False:
        bag = work / f"foreign_{'little' if little_endian else 'big'}_endian"
        with rosbags.rosbag2.Writer(bag, version=9, storage_plugin=rosbags.rosbag2.StoragePlugin.MCAP) as writer:
            topic = writer.add_connection("/imu", imu, typestore=types)
            for index, (time, values) in enumerate(samples):
                sample = message(index, time, values, "x" * (index % 11))
                data = types.serialize_cdr(sample, imu, little_endian=little_endian)
                writer.write(topic, 10**9 + index * 1000, data)
        expect(ok("to-csv", bag, "-") == expected, bag)

    def bag_of(name, stamps, values=(1.0, 2.0, 3.0, 4.0, 5.0, 6.0), cut=None):
        with rosbags.rosbag2.Writer(work / name, version=9) as writer:
            topic = writer.add_connection("/imu", imu, typestore=types)
            for index, stamp in enumerate(stamps):
                writer.write(topic, index, bytes(types.serialize_cdr(message(0, stamp, values, "imu"), imu))[:cut])
        return work / name

    twice = bag_of("twice", [5, 7, 7])
    refused(["to-csv", twice, work / "no.csv"], "message 3 of /imu has stamp 7 ns after 7, expected increasing header stamps",
            "--drop-duplicates")
    rows = "".join(f"{stamp},1.0,2.0,3.0,4.0,5.0,6.0\n" for stamp in (5, 7, 7))
    expect(ok("to-csv", twice, "-", "--keep-duplicates", "--name-topic") == "#topic /imu\n" + header + rows, twice)
    refused(["to-csv", bag_of("back", [5, 7, 6]), work / "no.csv", "--keep-duplicates"],
            "message 3 of /imu has stamp 6 ns after 7, expected increasing header stamps\n")
    refused(["to-csv", bag_of("empty", []), work / "no.csv"], "no messages on /imu")
    refused(["to-csv", bag_of("nan", [5], (1.0, float("nan"), 0.0, 0.0, 0.0, 0.0)), work / "no.csv"], "message 1", "finite")
    refused(["to-csv", bag_of("cut", [5], cut=100), work / "no.csv"], "message 1 of /imu is not a sensor_msgs/Imu")
    with rosbags.rosbag2.Writer(work / "texts", version=9) as writer:
        writer.add_connection("/text", "std_msgs/msg/String", typestore=types)
    refused(["to-csv", work / "texts", work / "no.csv"], "no topic of sensor_msgs/Imu", "/text (std_msgs/msg/String)")


def check_bad_input(csv, bag):
    refused(["to-bag", work / "none.csv", work / "no.bag"], "none.csv: No such file")
    refused(["to-bag", csv, work / "none" / "no.bag"], "none: no such folder")
    refused(["to-bag", csv, work / "no.bag", "--topic", "imu 0"], "'imu 0' is not a topic")
    refused(["to-bag", csv, work / "no.txt"], "unknown ending .txt", "expected .bag, .mcap")
    refused(["to-bag", csv, work], "exists already", "new folder")
    bad = work / "bad.csv"
    for text, *says in [
        ("", "no samples, expected lines timestamp [ns]"),
        (header, "no samples"),
        (header + "1,2,3,4,5,6\n", "bad.csv:2: '1,2,3,4,5,6', expected 7 finite numbers: timestamp [ns]"),
        (header + "1,2,3,4,5,6,7,8\n", "bad.csv:2:"),
        (header + "1.5,2,3,4,5,6,7\n", "bad.csv:2:"),
        (header + "1,2,3,4,x,6,7\n", "bad.csv:2:"),
        (header + "1,2,3,4,nan,6,7\n", "bad.csv:2:", "finite"),
        (header + "1,2,3,4,1_0,6,7\n", "bad.csv:2:"),
        (header + "5,2,3,4,5,6,7\n5,2,3,4,5,6,7\n", "bad.csv:3: timestamp 5 after 5, expected increasing"),
        (header + "-5,2,3,4,5,6,7\n", "bad.csv:2: timestamp -5, expected a time of 0 or more"),
        (header + "9000000000000000000,2,3,4,5,6,7\n", "9000000000000000000 ns, expected less than"),
        ("\x7fELF\xff\0\n", "bad.csv:1:"),
    ]:
        bad.write_text(text)
        for output in "no.bag", "no":
            refused(["to-bag", bad, work / output], *says)

    refused(["to-csv", work / "none.bag", work / "no.csv"], "none.bag: no such file")
    refused(["to-csv", csv, work / "no.csv"], "imu.csv: unknown ending, expected a ROS 1 .bag, or a ROS 2")
    refused(["to-csv", work, work / "no.csv"], "no metadata.yaml")
    refused(["to-csv", bag, work / "none" / "no.csv"], "none: no such folder")
    refused(["to-csv", bag, work], "exists and is not a regular file")
    kept = bag.read_bytes(), csv.read_bytes()
    (work / "link.csv").symlink_to(csv)
    (work / "link.bag").symlink_to(bag)
    for same in bag, work / "link.bag":
        refused(["to-csv", bag, same], "is read by this run and would be replaced by it, expected another output")
        refused(["to-csv", same, bag], "is read by this run and would be replaced by it, expected another output")
    for same in csv, work / "link.csv":
        refused(["to-bag", csv, same, "--format", "ros1"], "is read by this run and would be replaced by it")
    expect((bag.read_bytes(), csv.read_bytes()) == kept, "an input has been replaced")
    (work / "link.csv").unlink()
    (work / "link.bag").unlink()
    for name in "cut.bag", "cut.mcap", "cut.db3":
        for size in 0, 10, 5000, 50000:
            whole = (work / name.replace("cut", "imu")).read_bytes()
            (work / name).write_bytes(whole[:size])
            refused(["to-csv", work / name, work / "no.csv"], name)


def main():
    shutil.rmtree(work, ignore_errors=True)
    work.mkdir(parents=True)
    samples = make_samples()
    csv = write_csv(work / "imu.csv", samples)
    expected = csv.read_text()
    for output, *options in [("imu.bag",), ("imu.mcap",), ("imu.db3",), ("mcap",), ("sqlite", "--format", "ros2-sqlite")]:
        bag = work / output
        ok("to-bag", csv, bag, *options)
        check_with_rosbags(bag, samples, "/imu0", "imu")
        back = work / "back.csv"
        ok("to-csv", bag, back)
        expect(back.read_text() == expected, bag, "reads back differently")
        expect(ok("to-csv", bag, "-", "--topic", "/imu0") == expected, bag, "reads back differently to standard output")
        if bag.is_file():
            ok("to-bag", csv, bag)  # replaces it
            ok("to-bag", csv, bag, "--topic", "/left/imu", "--frame", "camera_left")
            check_with_rosbags(bag, samples, "/left/imu", "camera_left")
            ok("to-bag", csv, bag)
    blanks = work / "blanks.csv"
    blanks.write_text(expected.replace(header, "").replace(",", " "))
    ok("to-bag", blanks, work / "blanks.bag")
    check_with_rosbags(work / "blanks.bag", samples, "/imu0", "imu")
    check_with_ros(work / "imu.bag", samples)
    check_foreign_bags(samples[1:])
    check_bad_input(csv, work / "imu.bag")
    print(f"{len(samples)} samples: ROS 1, mcap and sqlite bags are the same as the csv")


main()

#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Converts IMU logs between ROS bags and the csv files of the EuRoC dataset, with the Python package rosbags, not ROS.

    imu_bag.py to-csv log.bag imu.csv                 # ROS 1
    imu_bag.py to-csv log_folder - --topic /imu0      # ROS 2; - is the standard output
    imu_bag.py to-bag imu.csv log.bag                 # or log.mcap, or a ROS 2 folder

Times are those of the message headers, not of their arrival; they and all numbers keep every bit.
"""
import argparse
import contextlib
import gc
import importlib.metadata
import itertools
import math
import os
import pathlib
import re
import signal
import sqlite3
import struct
import sys
import tempfile
import time

MESSAGE = "sensor_msgs/msg/Imu"
HEADER = ("#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
          "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]")
SUFFIXES = {"ros1": ".bag", "ros2-mcap": ".mcap", "ros2-sqlite": ".db3"}


class Failure(Exception):
    """One line about what is wrong, where, and what was expected."""


# The bytes of a sensor_msgs/Imu are the same in ROS 1 and in ROS 2 (CDR) but for the first 4, which are a counter or
# the encoding, and for the frame's name, which CDR ends with a zero and pads, so that the numbers begin at a multiple
# of 8. rosbags' own functions, made for any message, halve the speed of the whole; tests/examples/imu_bag_check.py compares.
CDR_LITTLE_ENDIAN = 0x100
NO_ORIENTATION = struct.pack("<13d", 0, 0, 0, 1, -1, *[0] * 8)  # quaternion, and its covariance: -1 is "not measured"


def encoder(frame, ros1):
    """A function of (index, stamp, six numbers) that returns a message's bytes."""
    name = frame.encode()
    if not ros1:
        name += b"\0"
    name = struct.pack("<I", len(name)) + name
    if not ros1:
        name += b"\0" * (-len(name) % 8)
    fixed = name + NO_ORIENTATION
    pack = struct.Struct(f"<III{len(fixed)}s3d72x3d72x").pack  # the covariances, 72 bytes, are 0: unknown
    if ros1:
        return lambda index, stamp, values: pack(index, *divmod(stamp, 10**9), fixed, *values)
    return lambda index, stamp, values: pack(CDR_LITTLE_ENDIAN, *divmod(stamp, 10**9), fixed, *values)


def decoder(ros1):
    """A function of a message's bytes that returns (stamp, wx, wy, wz, ax, ay, az)."""
    numbers = "104x3d72x3d72x"
    little = struct.Struct("<4xIII").unpack_from, struct.Struct("<" + numbers).unpack_from
    big = struct.Struct(">4xIII").unpack_from, struct.Struct(">" + numbers).unpack_from

    def decode(data):
        order = little
        if not ros1 and data[:2] != b"\0\1":
            if data[:2] != b"\0\0":
                raise ValueError(f"encoding {data[:2].hex()}, expected plain CDR")
            order = big
        seconds, nanoseconds, length = order[0](data)
        start = 16 + length if ros1 else 4 + (12 + length + 7) // 8 * 8
        if not 0 <= len(data) - start - 37 * 8 < 4:  # some writers of CDR pad the end
            raise ValueError(f"{len(data)} bytes, expected {start + 37 * 8}")
        return seconds * 10**9 + nanoseconds, *order[1](data, start)

    return decode


class Progress:
    """A line on standard error, for a person who waits: only on a terminal, and only after a second."""

    def __init__(self):
        self.start = time.monotonic()
        self.next = self.start + 1 if sys.stderr.isatty() else math.inf
        self.drawn = False

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.drawn:
            print(end="\r\033[K", file=sys.stderr, flush=True)

    def at(self, share):
        now = time.monotonic()
        if now < self.next or not share > 0:
            return
        self.next = now + 0.2
        self.drawn = True
        filled = round(40 * min(share, 1))
        left = (now - self.start) * max(1 / share - 1, 0)
        bar = "=" * filled + " " * (40 - filled)
        print(f"\r[{bar}] {share:4.0%}, {left:.0f} s left ", end="", file=sys.stderr, flush=True)


@contextlib.contextmanager
def replacing(target):
    """Gives a path beside the target to write a file or folder to, which becomes the target if all goes well."""
    if not target.parent.is_dir():
        raise Failure(f"{target.parent}: no such folder")
    with tempfile.TemporaryDirectory(prefix=f".{target.name}.", suffix=".tmp", dir=target.parent) as folder:
        temporary = pathlib.Path(folder, target.name)
        yield temporary
        os.replace(temporary, target)


def import_rosbags():
    try:
        import rosbags.rosbag1
        import rosbags.rosbag2
        import rosbags.typesys
    except ImportError as error:
        if error.name and error.name.split(".")[0] != "rosbags":
            raise Failure(f"the Python package rosbags needs {error.name} (pip install {error.name})") from None
        raise Failure("needs the Python package rosbags (pip install rosbags)") from None
    version = importlib.metadata.version("rosbags")
    if tuple(map(int, version.split(".")[:2])) < (0, 11):
        raise Failure(f"needs rosbags 0.11 or newer, this is {version} (pip install --upgrade rosbags)")
    return rosbags


def read_csv(path, progress):
    """The samples (stamp, (wx, wy, wz, ax, ay, az)) of a EuRoC file."""
    stamp, found, done = -1, False, 0
    size = path.stat().st_size
    with open(path, "rb") as file:
        for number, line in enumerate(file, 1):
            done += len(line)
            if number % 4096 == 0:
                progress.at(done / size)
            if line.startswith(b"#") or line.isspace():
                continue
            last = stamp
            try:
                stamp, wx, wy, wz, ax, ay, az = line.split(b",") if b"," in line else line.split()
                stamp, values = int(stamp), (float(wx), float(wy), float(wz), float(ax), float(ay), float(az))
            except ValueError:
                values = (math.nan,)
            if not math.isfinite(sum(values)) or b"_" in line:  # Python takes 1_000 for a number
                raise Failure(f"{path}:{number}: {excerpt(line)!r}, expected 7 finite numbers: {HEADER[1:]}")
            if stamp <= last:
                expected = "a time of 0 or more" if stamp < 0 else "increasing times"
                raise Failure(f"{path}:{number}: timestamp {stamp}{f' after {last}' * found}, expected {expected} in ns")
            found = True
            yield stamp, values
    if not found:
        raise Failure(f"{path}: no samples, expected lines {HEADER[1:]}")


def excerpt(line):
    text = line.decode(errors="replace").strip()
    return text if len(text) <= 60 else text[:57] + "..."


def write_bag(arguments, progress):
    rosbags = import_rosbags()
    source, output = pathlib.Path(arguments.input), pathlib.Path(arguments.output)
    form = arguments.format or {suffix: form for form, suffix in SUFFIXES.items()}.get(output.suffix)
    if not form:
        if output.suffix:
            raise Failure(f"{output}: unknown ending {output.suffix}, expected .bag, .mcap, a folder, or a --format")
        form = "ros2-mcap"
    if not re.fullmatch(r"(/\w+)+", arguments.topic, re.ASCII):
        raise Failure(f"{arguments.topic!r} is no topic, expected a name such as /imu0")
    target = output.resolve()
    single = output.suffix == SUFFIXES[form]
    ros1 = form == "ros1"
    if ros1 or single:
        if target.exists() and not target.is_file():
            raise Failure(f"{output}: exists and is not a regular file")
    elif target.exists() and not (target.is_dir() and not any(target.iterdir())):
        raise Failure(f"{output}: exists already, expected the name of a new folder")
    latest = (2**32 if ros1 else 2**31) * 10**9
    encode = encoder(arguments.frame, ros1)
    with replacing(target) as temporary:
        if ros1:
            writer = rosbags.rosbag1.Writer(temporary)
            types = rosbags.typesys.get_typestore(rosbags.typesys.Stores.ROS1_NOETIC)
        else:
            storage = rosbags.rosbag2.StoragePlugin
            plugin = storage.MCAP if form == "ros2-mcap" else storage.SQLITE3
            folder = temporary.with_suffix("") if single else temporary
            # Version 8 is what Humble and all since can read.
            writer = rosbags.rosbag2.Writer(folder, version=8, storage_plugin=plugin)
            types = rosbags.typesys.get_typestore(rosbags.typesys.Stores.ROS2_HUMBLE)
        with writer:
            topic = writer.add_connection(arguments.topic, MESSAGE, typestore=types)
            write = writer.write
            for index, (stamp, values) in enumerate(read_csv(source, progress)):
                if stamp >= latest:
                    raise Failure(f"{source}: timestamp {stamp} ns, expected less than {latest}, the end of ROS times")
                write(topic, stamp, encode(index, stamp, values))
        if not ros1 and single:
            os.replace(folder / temporary.name, temporary)


def open_bag(path):
    rosbags = import_rosbags()
    if not path.exists():
        raise Failure(f"{path}: no such file or folder, expected a ROS 1 .bag, or a ROS 2 .mcap, .db3 or folder")
    if path.is_dir() and not (path / "metadata.yaml").is_file():
        raise Failure(f"{path}: no metadata.yaml in it, expected the folder of a ROS 2 bag")
    if not path.is_dir() and path.suffix not in SUFFIXES.values():
        raise Failure(f"{path}: unknown ending, expected a ROS 1 .bag, or a ROS 2 .mcap, .db3 or folder")
    ros1 = path.suffix == ".bag" and not path.is_dir()
    return (rosbags.rosbag1 if ros1 else rosbags.rosbag2).Reader(path), ros1


def choose_topic(path, connections, wanted):
    imus = [connection for connection in connections if connection.msgtype == MESSAGE]
    topics = sorted({connection.topic for connection in imus})
    listed = ", ".join(topics)
    if not topics:
        others = ", ".join(sorted({f"{connection.topic} ({connection.msgtype})" for connection in connections}))
        raise Failure(f"{path}: no topic of sensor_msgs/Imu{', only ' + others if others else ''}")
    if wanted is None and len(topics) > 1:
        raise Failure(f"{path}: several IMU topics, expected --topic with one of {listed}")
    if wanted is not None and wanted not in topics:
        raise Failure(f"{path}: no IMU topic {wanted}, expected one of {listed}")
    return [connection for connection in imus if connection.topic == (wanted or topics[0])]


def guarded(path, items):
    """The items; whatever goes wrong inside the reader (it meets damaged files with all sorts of exceptions) is said."""
    try:
        yield from items
    except Exception as error:
        raise Failure(unreadable(path, error)) from None


def unreadable(path, error):
    # The type too, as texts such as "unpack requires 4 bytes" say little.
    return f"{path}: damaged or no such bag: {type(error).__name__}: {' '.join(str(error).split())}"


def read_bag(path, wanted, progress):
    """The samples (stamp, wx, wy, wz, ax, ay, az) of a bag, as they arrived."""
    with contextlib.ExitStack() as stack:
        try:
            reader, ros1 = open_bag(path)
            stack.enter_context(reader)
        except (Failure, PermissionError):
            raise
        except Exception as error:
            raise Failure(unreadable(path, error)) from None
        connections = choose_topic(path, reader.connections, wanted)
        topic = connections[0].topic
        total = max(1, sum(connection.msgcount for connection in connections))
        decode = decoder(ros1)
        last, index = -1, -1
        for index, (_, _, data) in enumerate(guarded(path, reader.messages(connections))):
            if index % 4096 == 0:
                progress.at(index / total)
            try:
                sample = decode(data)
            except (struct.error, ValueError) as error:
                raise Failure(f"{path}: message {index + 1} of {topic} is no sensor_msgs/Imu: {error}") from None
            if not sample[0] > last:
                raise Failure(f"{path}: message {index + 1} of {topic} has stamp {sample[0]} ns after {last}, "
                              "expected increasing header stamps" if index else
                              f"{path}: the first message of {topic} has stamp {sample[0]} ns, expected 0 or more")
            last = sample[0]
            yield sample
        if index < 0:
            raise Failure(f"{path}: no messages on {topic}")


def write_csv(arguments, progress):
    source = pathlib.Path(arguments.input)
    samples = read_bag(source, arguments.topic, progress)
    samples = itertools.chain([next(samples)], samples)  # most of what can be wrong is found before anything is written
    with contextlib.ExitStack() as stack:
        if arguments.output == "-":
            signal.signal(signal.SIGPIPE, signal.SIG_DFL)
            file = sys.stdout
        else:
            target = pathlib.Path(arguments.output).resolve()
            if target.exists() and not target.is_file():
                raise Failure(f"{arguments.output}: exists and is not a regular file; - is the standard output")
            file = stack.enter_context(open(stack.enter_context(replacing(target)), "w", newline="\n"))
        write = file.write
        write(HEADER + "\n")
        for index, (stamp, wx, wy, wz, ax, ay, az) in enumerate(samples, 1):
            line = f"{stamp},{wx!r},{wy!r},{wz!r},{ax!r},{ay!r},{az!r}\n"
            if "n" in line:  # nan or inf
                raise Failure(f"{source}: message {index} is {line.strip()}, expected finite numbers")
            write(line)
        file.flush()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True, metavar="to-bag|to-csv")
    command = commands.add_parser("to-bag", help="write sensor_msgs/Imu messages of a EuRoC csv")
    command.add_argument("input", help="csv: ns,wx,wy,wz,ax,ay,az")
    command.add_argument("output", help="log.bag (ROS 1), log.mcap, log.db3, or a new folder (ROS 2)")
    command.add_argument("--topic", default="/imu0", help="(%(default)s)")
    command.add_argument("--frame", default="imu", help="frame_id of the headers (%(default)s)")
    command.add_argument("--format", choices=SUFFIXES, help="if the output's name does not say; a folder is mcap")
    command.set_defaults(run=write_bag)
    command = commands.add_parser("to-csv", help="read sensor_msgs/Imu messages of a bag")
    command.add_argument("input", help="log.bag (ROS 1), log.mcap, log.db3 or a folder (ROS 2)")
    command.add_argument("output", help="csv to write, - for the standard output")
    command.add_argument("--topic", help="needed if there are several with IMU messages")
    command.set_defaults(run=write_csv)
    arguments = parser.parse_args()

    gc.disable()  # nothing here makes cycles, and looking for them among the index of a large bag takes a fifth of the time
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # so that temporaries go
    try:
        with Progress() as progress:
            arguments.run(arguments, progress)
    except Failure as failure:
        problem = str(failure)
    except OSError as error:
        output = "standard output" if arguments.output == "-" else arguments.output
        problem = f"{error.filename or output}: {error.strerror or error}"
    except sqlite3.Error as error:
        problem = f"{arguments.output}: {error}"
    except KeyboardInterrupt:
        sys.exit(130)
    else:
        return
    print(f"imu_bag.py: {problem}", file=sys.stderr)
    sys.exit(2)


if __name__ == "__main__":
    main()

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
import itertools
import math
import os
import pathlib
import re
import struct
import sys

import standard_output
from bag_files import SUFFIXES, Failure, choose_topic, guarded, import_rosbags, keep_input, opened, replacing, run

MESSAGE = "sensor_msgs/msg/Imu"
HEADER = ("#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
          "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]")


# The bytes of a sensor_msgs/Imu are the same in ROS 1 and in ROS 2 (CDR) except for the first 4 bytes, which are a
# counter (ROS 1) or the encoding (CDR), and for the frame's name, which CDR ends with a zero and pads, so that the
# numbers begin at a multiple of 8. The functions of rosbags, which handle any message, would halve the speed of the
# whole script. tests/tools/imu_bag_check.py compares the results with them.
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


def read_csv(path, progress):
    """Yields the samples (stamp, (wx, wy, wz, ax, ay, az)) of a EuRoC file."""
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


def expect_writable(output, target, is_file):
    """A file may replace a file; a folder must be new or empty."""
    if is_file:
        if target.exists() and not target.is_file():
            raise Failure(f"{output}: exists and is not a regular file")
    elif target.exists() and not (target.is_dir() and not any(target.iterdir())):
        raise Failure(f"{output}: exists already, expected the name of a new folder")


def write_bag(arguments, progress):
    rosbags = import_rosbags()
    source, output = pathlib.Path(arguments.input), pathlib.Path(arguments.output)
    keep_input(source, output)
    form = arguments.format or {suffix: form for form, suffix in SUFFIXES.items()}.get(output.suffix)
    if not form:
        if output.suffix:
            raise Failure(f"{output}: unknown ending {output.suffix}, expected .bag, .mcap, a folder, or a --format")
        form = "ros2-mcap"
    if not re.fullmatch(r"(/\w+)+", arguments.topic, re.ASCII):
        raise Failure(f"{arguments.topic!r} is not a topic, expected a name such as /imu0")
    target = output.resolve()
    single = output.suffix == SUFFIXES[form]
    ros1 = form == "ros1"
    expect_writable(output, target, ros1 or single)
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
            # Humble and all later releases can read version 8.
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


def read_bag(path, wanted, duplicates, progress):
    """Yields the topic, then the samples (stamp, wx, wy, wz, ax, ay, az) of a bag in the order of arrival."""
    with opened(path) as (reader, ros1):
        connections = choose_topic(path, reader.connections, [MESSAGE], "IMU", wanted)
        topic = connections[0].topic
        total = max(1, sum(connection.msgcount for connection in connections))
        decode = decoder(ros1)
        yield topic
        last, index = -1, -1
        for index, (_, _, data) in enumerate(guarded(path, reader.messages(connections))):
            if index % 4096 == 0:
                progress.at(index / total)
            try:
                sample = decode(data)
            except (struct.error, ValueError) as error:
                raise Failure(f"{path}: message {index + 1} of {topic} is not a sensor_msgs/Imu: {error}") from None
            if not sample[0] > last and not (duplicates and sample[0] == last >= 0):
                raise Failure(f"{path}: message {index + 1} of {topic} has stamp {sample[0]} ns after {last}, "
                              "expected increasing header stamps" +
                              " (allan: --drop-duplicates)" * (sample[0] == last) if index else
                              f"{path}: the first message of {topic} has stamp {sample[0]} ns, expected 0 or more")
            last = sample[0]
            yield sample
        if index < 0:
            raise Failure(f"{path}: no messages on {topic}")


def write_csv(arguments, progress):
    source = pathlib.Path(arguments.input)
    keep_input(source, pathlib.Path(arguments.output))
    samples = read_bag(source, arguments.topic, arguments.keep_duplicates, progress)
    topic = next(samples)
    samples = itertools.chain([next(samples)], samples)  # finds most errors before anything is written
    with contextlib.ExitStack() as stack:
        if arguments.output == "-":
            file = sys.stdout
        else:
            target = pathlib.Path(arguments.output).resolve()
            if target.exists() and not target.is_file():
                raise Failure(f"{arguments.output}: exists and is not a regular file; - is the standard output")
            file = stack.enter_context(open(stack.enter_context(replacing(target)), "w", newline="\n"))
        write = file.write
        if arguments.name_topic:
            write(f"#topic {topic}\n")
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
    command.add_argument("--topic", default="/imu0", help="topic to write (%(default)s)")
    command.add_argument("--frame", default="imu", help="frame_id of the headers (%(default)s)")
    command.add_argument("--format", choices=SUFFIXES, help="if the output's name does not show it; a folder is mcap")
    command.set_defaults(run=write_bag)
    command = commands.add_parser("to-csv", help="read sensor_msgs/Imu messages of a bag")
    command.add_argument("input", help="log.bag (ROS 1), log.mcap, log.db3 or a folder (ROS 2)")
    command.add_argument("output", help="csv to write, - for the standard output")
    command.add_argument("--topic", help="topic to read, needed if there are several with IMU messages")
    command.add_argument("--name-topic", action="store_true", help="begin with a line #topic NAME")
    command.add_argument("--keep-duplicates", action="store_true",
                         help="also write messages with the same stamp as the previous one")
    command.set_defaults(run=write_csv)
    with standard_output.checked("imu_bag.py"):
        arguments = parser.parse_args()
        output = standard_output.NAME if arguments.output == "-" else arguments.output
        run("imu_bag.py", arguments.run, arguments, output)


if __name__ == "__main__":
    main()

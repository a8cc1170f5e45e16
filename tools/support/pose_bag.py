#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints the poses of a topic in a ROS bag as lines of ns,x,y,z,qx,qy,qz,qw, with the Python package rosbags, not ROS.

    pose_bag.py log.bag                         # ROS 1
    pose_bag.py log_folder --topic /odometry    # ROS 2

Messages may be nav_msgs/Odometry and geometry_msgs/PoseStamped, PoseWithCovarianceStamped and TransformStamped. Times are
those of the message headers, not of their arrival; they and all numbers keep every bit. One line per message, in order.
"""
import argparse
import pathlib
import sys

import standard_output
from bag_files import Failure, choose_topic, guarded, import_rosbags, opened, run

# The position and the quaternion of a message of each type.
TYPES = {
    "nav_msgs/msg/Odometry": lambda m: (m.pose.pose.position, m.pose.pose.orientation),
    "geometry_msgs/msg/PoseStamped": lambda m: (m.pose.position, m.pose.orientation),
    "geometry_msgs/msg/PoseWithCovarianceStamped": lambda m: (m.pose.pose.position, m.pose.pose.orientation),
    "geometry_msgs/msg/TransformStamped": lambda m: (m.transform.translation, m.transform.rotation),
}


def print_poses(arguments, progress):
    path = pathlib.Path(arguments.input)
    with opened(path) as (reader, ros1):
        connections = choose_topic(path, reader.connections, list(TYPES), "pose", arguments.topic)
        topic = connections[0].topic
        rosbags = import_rosbags()
        stores = rosbags.typesys.Stores
        types = rosbags.typesys.get_typestore(stores.ROS1_NOETIC if ros1 else stores.ROS2_HUMBLE)
        decode = types.deserialize_ros1 if ros1 else types.deserialize_cdr
        total = max(1, sum(connection.msgcount for connection in connections))
        count = 0
        for connection, _, data in guarded(path, reader.messages(connections)):
            if count % 1024 == 0:
                progress.at(count / total)
            count += 1
            try:
                message = decode(data, connection.msgtype)
            except Exception as error:
                raise Failure(f"{path}: message {count} of {topic} is not a {connection.msgtype}: {error}") from None
            stamp = message.header.stamp
            p, q = TYPES[connection.msgtype](message)
            values = ",".join(repr(float(value)) for value in (p.x, p.y, p.z, q.x, q.y, q.z, q.w))
            print(f"{stamp.sec * 10**9 + stamp.nanosec},{values}")
        if count == 0:
            raise Failure(f"{path}: no messages on {topic}")
        sys.stdout.flush()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("input", help="log.bag (ROS 1), log.mcap, log.db3 or a folder (ROS 2)")
    parser.add_argument("--topic", help="topic to read, needed if there are several with poses")
    with standard_output.checked("pose_bag.py"):
        run("pose_bag.py", print_poses, parser.parse_args(), standard_output.NAME)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: MIT
"""Shared by the scripts for ROS bags: opening a bag with the Python package rosbags, and exit codes."""
import contextlib
import gc
import importlib.metadata
import math
import os
import pathlib
import signal
import sqlite3
import sys
import tempfile
import time

import standard_output

SUFFIXES = {"ros1": ".bag", "ros2-mcap": ".mcap", "ros2-sqlite": ".db3"}


class Failure(Exception):
    """One line about what is wrong, where, and what was expected."""


class Progress:
    """A progress bar on standard error: only on a terminal, and only after a second."""

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
    """Yields a temporary path beside the target. The file or folder written there replaces the target on success."""
    if not target.parent.is_dir():
        raise Failure(f"{target.parent}: no such folder")
    with tempfile.TemporaryDirectory(prefix=f".{target.name}.", suffix=".tmp", dir=target.parent) as folder:
        temporary = pathlib.Path(folder, target.name)
        yield temporary
        os.replace(temporary, target)


def keep_input(source, output):
    """Raises Failure if the output is the input, or a file in it if the input is a folder."""
    for path in [source, *source.iterdir()] if source.is_dir() else [source]:
        if path.is_file() and output.is_file() and path.samefile(output):
            raise Failure(f"{output}: is read by this run and would be replaced by it, expected another output")


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


def choose_topic(path, connections, types, kind, wanted):
    """The connections of the wanted topic, or of the only topic, with messages of one of the types."""
    suitable = [connection for connection in connections if connection.msgtype in types]
    topics = sorted({connection.topic for connection in suitable})
    listed = ", ".join(topics)
    if not topics:
        others = ", ".join(sorted({f"{connection.topic} ({connection.msgtype})" for connection in connections}))
        names = " or ".join(name.replace("/msg/", "/") for name in types)
        raise Failure(f"{path}: no topic of {names}{', only ' + others if others else ''}")
    if wanted is None and len(topics) > 1:
        raise Failure(f"{path}: several {kind} topics, expected --topic with one of {listed}")
    if wanted is not None and wanted not in topics:
        raise Failure(f"{path}: no {kind} topic {wanted}, expected one of {listed}")
    return [connection for connection in suitable if connection.topic == (wanted or topics[0])]


@contextlib.contextmanager
def opened(path):
    """Yields the open reader of a bag, and whether it is a ROS 1 bag."""
    with contextlib.ExitStack() as stack:
        try:
            reader, ros1 = open_bag(path)
            stack.enter_context(reader)
        except (Failure, PermissionError):
            raise
        except Exception as error:
            raise Failure(unreadable(path, error)) from None
        yield reader, ros1


def guarded(path, items):
    """Yields the items. Any exception of the reader, which has many types for damaged files, becomes a Failure."""
    try:
        yield from items
    except Exception as error:
        raise Failure(unreadable(path, error)) from None


def unreadable(path, error):
    # With the type, because texts such as "unpack requires 4 bytes" say little.
    return f"{path}: damaged, or not a ROS bag: {type(error).__name__}: {' '.join(str(error).split())}"


def run(script, command, arguments, output):
    """Runs command(arguments, progress). If something is wrong, prints one line about it and exits with code 2. An
    OSError of the standard output is left to standard_output.checked()."""
    gc.disable()  # there are no reference cycles, and searching the index of a large bag takes a fifth of the time
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))  # so that temporary files are removed
    try:
        with Progress() as progress:
            command(arguments, progress)
    except Failure as failure:
        problem = str(failure)
    except OSError as error:
        if output == standard_output.NAME and error.filename is None:
            raise
        problem = f"{error.filename or output}: {error.strerror or error}"
    except sqlite3.Error as error:
        problem = f"{output}: {error}"
    except KeyboardInterrupt:
        sys.exit(130)
    else:
        return
    print(f"{script}: {problem}", file=sys.stderr)
    sys.exit(2)

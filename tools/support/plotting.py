# SPDX-License-Identifier: MIT
"""Shared by the plotting scripts: colours, errors in one line, and pictures that are complete or not written at all."""
import argparse
import os
import pathlib
import signal
import stat
import sys

import standard_output

# The colours of Okabe and Ito, which people with colour vision deficiency can tell apart.
BLUE, ORANGE, GREEN, RED, PURPLE, SKY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9"


class Failure(Exception):
    """One line about what is wrong, where, and what was expected."""


def parser(description):
    return argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)


def save(figure, picture):
    """Writes the figure in the format of the path's suffix. As in the programs, links are followed, permissions are
    kept, and a target that is read-only or not a regular file is rejected."""
    form = picture.suffix[1:]
    target = pathlib.Path(os.path.realpath(picture))
    old = target.stat() if target.exists() else None
    if old and not stat.S_ISREG(old.st_mode):
        raise Failure(f"{picture}: exists and is not a regular file")
    if old and not (old.st_mode & 0o222 and os.access(target, os.W_OK)):
        raise Failure(f"{picture}: is read-only")
    temporary = target.with_name(f".splinertia.{os.getpid()}.tmp")  # short, because names have a maximum length
    try:
        figure.savefig(temporary, format=form, metadata={"Date": None} if form == "svg" else None)
        if old:
            os.chmod(temporary, stat.S_IMODE(old.st_mode) & 0o777)
        os.replace(temporary, target)
    finally:
        temporary.unlink(missing_ok=True)


def script_name():
    return pathlib.Path(sys.argv[0]).name


def run(work):
    """Calls work(), which draws. A Failure or a file that cannot be used ends the script with one line and code 2."""
    signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))  # so that save() removes its temporary file
    try:
        try:
            import matplotlib
        except ImportError:
            raise Failure("needs the Python package matplotlib (pip install matplotlib)") from None
        matplotlib.rcParams.update({"svg.hashsalt": "splinertia", "svg.fonttype": "none"})  # reproducible
        work()
        return
    except Failure as failure:
        problem = str(failure)
    except OSError as error:
        problem = f"{error.filename}: {error.strerror}"
    print(f"{script_name()}: {problem}", file=sys.stderr)
    sys.exit(2)


def run_on_folder(description, folder_help, name, draw):
    """A script with the arguments FOLDER and --output NAME: writes draw(folder) to FOLDER/NAME.png and NAME.svg."""
    arguments = parser(description)
    arguments.add_argument("folder", type=pathlib.Path, help=folder_help)
    arguments.add_argument("--output", default=name, metavar="NAME",
                           help="name of the pictures, without .png (%(default)s)")

    def work(given):
        figure = draw(given.folder)
        for form in "png", "svg":
            save(figure, given.folder / f"{given.output}.{form}")

    with standard_output.checked(script_name()):
        given = arguments.parse_args()
        run(lambda: work(given))

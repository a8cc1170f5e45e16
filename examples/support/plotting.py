# SPDX-License-Identifier: MIT
"""What the plotting scripts share: colours, errors in one line, and pictures that are there complete or not at all."""
import argparse
import os
import pathlib
import signal
import stat
import sys

import standard_output

# Okabe and Ito's colours, which look different to everybody.
BLUE, ORANGE, GREEN, RED, PURPLE, SKY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9"


class Failure(Exception):
    """One line about what is wrong, where, and what was expected."""


def parser(description):
    return argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)


def save(figure, picture):
    """In the form that the suffix of the path names. As the programs write: links are followed, permissions stay, what is
    read-only or no file is refused."""
    form = picture.suffix[1:]
    target = pathlib.Path(os.path.realpath(picture))
    old = target.stat() if target.exists() else None
    if old and not stat.S_ISREG(old.st_mode):
        raise Failure(f"{picture}: exists and is not a regular file")
    if old and not (old.st_mode & 0o222 and os.access(target, os.W_OK)):
        raise Failure(f"{picture}: is read-only")
    temporary = target.with_name(f".splinertia.{os.getpid()}.tmp")  # short: names can be as long as they may
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
    signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))  # not before save() has tidied up
    try:
        try:
            import matplotlib
        except ImportError:
            raise Failure("needs the Python package matplotlib (pip install matplotlib)") from None
        matplotlib.rcParams.update({"svg.hashsalt": "splinertia", "svg.fonttype": "none"})  # the same picture every time
        work()
        return
    except Failure as failure:
        problem = str(failure)
    except OSError as error:
        problem = f"{error.filename}: {error.strerror}"
    print(f"{script_name()}: {problem}", file=sys.stderr)
    sys.exit(2)


def run_on_folder(description, folder_help, name, draw):
    """A script with the arguments FOLDER and --output NAME: draw(folder) becomes FOLDER/NAME.png and FOLDER/NAME.svg."""
    arguments = parser(description)
    arguments.add_argument("folder", type=pathlib.Path, help=folder_help)
    arguments.add_argument("--output", default=name, metavar="NAME", help="of the pictures, without .png (%(default)s)")

    def work(given):
        figure = draw(given.folder)
        for form in "png", "svg":
            save(figure, given.folder / f"{given.output}.{form}")

    with standard_output.checked(script_name()):
        given = arguments.parse_args()
        run(lambda: work(given))

# SPDX-License-Identifier: MIT
"""What the plotting scripts share: colours, errors in one line, and pictures that are there complete or not at all."""
import argparse
import os
import pathlib
import sys

import standard_output

# Okabe and Ito's colours, which look different to everybody.
BLUE, ORANGE, GREEN, RED, PURPLE, SKY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9"


class Failure(Exception):
    """One line about what is wrong, where, and what was expected."""


def parser(description):
    return argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)


def save(figure, picture):
    """In the form that the suffix of the path names."""
    form = picture.suffix[1:]
    temporary = picture.with_name(f".{picture.name}.tmp")
    try:
        figure.savefig(temporary, format=form, metadata={"Date": None} if form == "svg" else None)
        os.replace(temporary, picture)
    finally:
        temporary.unlink(missing_ok=True)


def script_name():
    return pathlib.Path(sys.argv[0]).name


def run(work):
    """Calls work(), which draws. A Failure or a file that cannot be used ends the script with one line and code 2."""
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

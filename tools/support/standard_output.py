# SPDX-License-Identifier: MIT
"""Makes lost standard output an error of the scripts: exit code 1, as in the programs."""
import contextlib
import os
import sys

NAME = "standard output"


@contextlib.contextmanager
def checked(script):
    """Flushes what the block has printed. If output is lost, the script exits with code 1 and prints the reason, unless
    the reader has closed the pipe."""
    if sys.stdout is None:  # closed; print() would silently drop everything
        sys.stdout = os.fdopen(os.open(os.devnull, os.O_RDONLY), "w")
    # Buffered in any case, because argparse ignores errors of unbuffered writes.
    sys.stdout = open(sys.stdout.fileno(), "w", encoding=sys.stdout.encoding, errors=sys.stdout.errors, closefd=False)
    try:
        try:
            yield
        finally:
            sys.stdout.flush()
    except OSError as error:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # Python flushes once more
        if not isinstance(error, BrokenPipeError):
            print(f"{script}: {NAME}: {error.strerror}", file=sys.stderr)
        sys.exit(1)

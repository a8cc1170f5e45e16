# SPDX-License-Identifier: MIT
"""allan_statistics.py and identify_logs together: what they print of short logs, what they refuse, and what they leave
behind.

    allan_statistics_check.py SCRIPT PROGRAM FOLDER"""

import array
import csv
import pathlib
import random
import subprocess
import sys

SCRIPT, PROGRAM, FOLDER = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
TABLE = FOLDER / "logs.csv"


def run(*command, given=b""):
    result = subprocess.run([str(part) for part in command], input=given, capture_output=True)
    return result.returncode, result.stdout.decode(), result.stderr.decode()


def statistics(*arguments):
    return run(sys.executable, SCRIPT, *arguments)


def expect(condition, what, *shown):
    if not condition:
        sys.exit(f"allan_statistics_check.py: {what}: {shown}")


def check_identify_logs():
    generator = random.Random(1)
    logs = [array.array("d", (generator.gauss(0, sigma) for _ in range(4000))) for sigma in (1, 3)]
    given = b"".join(log.tobytes() for log in logs)
    code, printed, errors = run(PROGRAM, 4000, 100, given=given)
    rows = list(csv.DictReader(printed.splitlines()))
    expect(code == 0 and len(rows) == 2 and errors == "", "two logs", code, printed, errors)
    for row, N in zip(rows, (0.1, 0.3)):
        expect(row["N_detected"] == "1" and abs(float(row["N_value"]) / N - 1) < 0.05, "N of white noise", row)
        expect(float(row["N_lower"]) < float(row["N_value"]) < float(row["N_upper"]), "interval of N", row)
        expect(0 < float(row["model_above"]) < 4 and 0 < float(row["model_below"]) < 4, "the model is true", row)
    # Of two axes, the mean square; neither axis agrees with it.
    code, printed, _ = run(PROGRAM, 4000, 100, "--axes", 2, given=given)
    rows = list(csv.DictReader(printed.splitlines()))
    expect(code == 0 and len(rows) == 1, "two axes", code, printed)
    expect(abs(float(rows[0]["N_value"]) / 0.05**0.5 - 1) < 0.05, "N of two axes", rows)
    expect(float(rows[0]["model_above"]) > 4, "the model is above the quieter axis", rows)
    expect(float(rows[0]["model_below"]) > 4, "the model is below the noisier axis", rows)
    for arguments, text, what in (((4000, 100), given[:-1], "expected 32000"), ((4000, -100), given, "rate"),
                                  ((4000, 100), given + bytes(3), "after 3 bytes"),
                                  ((2, 100), given, "samples"), ((4000, 100), bytes(32000), "constant")):
        code, printed, errors = run(PROGRAM, *arguments, given=text)
        expect(code == 2 and what in errors + printed, f"bad input: {what}", code, printed, errors)


def check_statistics():
    options = ("--hours", 0.05, "--runs", 3)
    cases = ("--case", "walk_5%", "--case", "step_5sigma", "--case", "rounded_4sigma", "--case", "axes_1_to_4",
             "--case", "flicker_0.2Hz", "--case", "missing")
    code, printed, errors = statistics(PROGRAM, *options, *cases, "--threads", 2, "--csv", TABLE)
    if "is not installed" in errors:
        sys.exit(errors)  # by which CTest knows that the rest is skipped
    expect(code == 0, "statistics", code, errors)
    expect("| axes_1_to_4 | 3 |" in printed and "| walk_5% |" in printed, "a line a case", printed)
    expect(sorted(path.name for path in FOLDER.iterdir()) == ["logs.csv"], "only the file asked for", FOLDER)
    rows = list(csv.DictReader(TABLE.open(newline="")))
    expect(len(rows) == 18, "a line a log", len(rows))
    white = [row for row in rows if row["case"] == "missing_walk_15%"]
    expect(all(abs(float(row["N_value"]) / float(row["truth_N"]) - 1) < 0.05 for row in white), "N", white)
    # A seed gives the same logs whatever else is asked for and how many work.
    code, again, _ = statistics("--read", TABLE)
    expect(code == 0 and again == printed, "the same tables from the file", again)
    one = FOLDER / "one.csv"
    code, _, errors = statistics(PROGRAM, *options, "--case", "step_5sigma", "--csv", one)
    expect(code == 0, "one case", code, errors)
    known = {row["run"]: row["N_value"] for row in rows if row["case"] == "step_5sigma"}
    found = {row["run"]: row["N_value"] for row in csv.DictReader(one.open(newline=""))}
    expect(found == known, "the same logs from the same seed", found, known)
    one.unlink()
    for arguments, what in (((PROGRAM, "--hours", "nan"), "--hours"), ((FOLDER / "absent",), "absent"),
                            (("--read", SCRIPT), "first line")):
        code, printed, errors = statistics(*arguments)
        expect(code == 2 and what in errors and printed == "", f"bad input: {what}", code, printed, errors)


FOLDER.mkdir(parents=True, exist_ok=True)
for path in FOLDER.iterdir():
    path.unlink()
check_identify_logs()
check_statistics()

"""Draws folders as allan writes them with tools/support/plot_allan.py, looks at the text and lines of the SVG, and at
what the script says to bad files.

    plot_allan_check.py WORK_DIR

Exit code 77: matplotlib is not installed, nothing was checked.
"""

import math
import pathlib
import re
import shutil
import subprocess
import sys

try:
    import matplotlib
except ImportError:
    print("skipped: the Python package matplotlib is not installed (pip install matplotlib)")
    sys.exit(77)

support = pathlib.Path(__file__).resolve().parents[2] / "tools/support"
sys.path.insert(0, str(support))
sys.dont_write_bytecode = True
import plot_allan
import plot_allan_files
import plot_allan_terms
import plotting

matplotlib.rcParams.update({"svg.hashsalt": "splinertia", "svg.fonttype": "none"})
work = pathlib.Path(sys.argv[1])
shutil.rmtree(work, ignore_errors=True)
UNITS = {"N": "rad/s/sqrt(Hz)", "K": "rad/s^2/sqrt(Hz)", "B": "rad/s", "Q": "rad", "R": "rad/s^2", "G": "rad/s",
         "W": "rad/s"}


def expect(condition, *what):
    if not condition:
        print("FAILED:", *what)
        sys.exit(1)


def write(name, axes, terms, findings=(), adequacy=None):
    """A log of 1000 s at 100 Hz with N = 1e-3 times a factor of each axis. terms: axis, name, value, status, time."""
    folder = work / name
    folder.mkdir(parents=True)
    curves, spectrum = [plot_allan_files.CURVES], [plot_allan_files.SPECTRUM]
    for axis, factor in axes.items():
        for i in range(16):
            tau, width = 0.01 * 2**i, 1.5 if i > 13 else 0.05
            deviation = factor * 1e-3 / math.sqrt(tau)
            curves.append(f"gyroscope,{axis},{2**i},{tau},9,{deviation},{deviation / (1 + width)},"
                          f"{deviation * (1 + width)},0,{deviation}")
            frequency = 50 / 2**i
            used = not any(kind == "excluded" and of == axis and start <= frequency <= end
                           for of, kind, start, end in findings)
            spectrum.append(f"gyroscope,{axis},{frequency},{factor * 1e-3},{factor * 1e-3},{2**(16 - i)},{used:d}")
    noise = [plot_allan_files.NOISE]
    for axis, term, value, status, time in terms:
        noise.append(f"gyroscope,{axis},{term},{status == 'detected':d},{value},{value},{2 * value},{value},"
                     f"{UNITS[term]},{time},{time},{time},{status},{(adequacy or {}).get(axis, 'adequate')}")
    lines = [plot_allan_files.FINDINGS, ',,log,0,1000,s,"$imu$.csv, 100 Hz,\n1000 s"', "gyroscope,x,note,nan,nan,,text",
             "gyroscope,x,step,0,0,s,of steps"]
    lines += [f"gyroscope,{axis},{kind},{start},{end},-,text" for axis, kind, start, end in findings]
    for file, text in ("curves", curves), ("spectrum", spectrum), ("noise", noise), ("findings", lines):
        (folder / f"{file}.csv").write_text("\n".join(text) + "\n", encoding="utf-8")
    return folder


def draw(folder):
    """The SVG."""
    plotting.save(plot_allan.draw_folder(folder), folder / "allan.svg")
    return (folder / "allan.svg").read_text(encoding="utf-8").replace("\N{NO-BREAK SPACE}", " ")


def dashed(svg):
    """Opacity and colour of the model lines, without that in the legend."""
    found = re.findall(r'stroke-dasharray: 6,3;[^"]*?stroke: (#[0-9a-f]{6})(?:; stroke-opacity: ([0-9.]+))?', svg)
    return [(colour, float(opacity or 1)) for colour, opacity in found][:-1]


def expect_texts(svg, present, absent):
    for text in present:
        expect(f">{text}</text>" in svg, text, "is not in the picture")
    for text in absent:
        expect(text not in svg, text, "is in the picture")


# Axes that agree: lines of terms with labels, one model.
terms = [(axis, *term) for axis in ("x", "y", "z", "all") for term in (
    ("N", 1e-3, "detected", ""), ("K", 3e-5, "detected", ""), ("B", 2e-4, "possible", ""), ("Q", 1e-6, "absent", ""))]
alike = write("alike", {"x": 1, "y": 1, "z": 1}, terms)
svg = draw(alike)
expect_texts(svg, ["$imu$.csv, 100 Hz, 1000 s", "Gyroscope", "N  0.00100 rad/s/√Hz  (3.44 °/√h)",
                   "K  3.00×10⁻⁵ rad/s²/√Hz",
                   "possible: B &lt; 4.0×10⁻⁴ rad/s",
                   "not detected: Q &lt; 2.0×10⁻⁶ rad", "frequency (Hz)", "model", "its terms, read at the dot"],
             ["left out", "disagree", "pale", "in part", "step"])
expect(dashed(svg) == [("#000000", 1)] * 2, dashed(svg))
expect(svg.count("stroke-opacity: 0.2625") == 6, "the uncertain ends of three curves and spectra are not paler")

# Axes that differ: a table, a model in the colour of each axis, pale where it was not fitted.
terms = [(axis, "N", 1e-3 * factor, "detected", "") for axis, factor in (("x", 1), ("y", 4), ("z", 2))]
terms += [("x", "K", 1e-6, "absent", ""), ("y", "K", 3e-5, "possible", ""), ("z", "G", 2e-4, "detected", 77)]
differ = write("differ", {"x": 1, "y": 4, "z": 2}, terms,
               [("x", "excluded", 0.7, 0.9), ("y", "unused", 20, 50), ("y", "misfit", 2, 9), ("z", "step", 600, 600),
                ("z", "freeze", 100, 110)], {"x": "partial", "y": "inadequate"})
svg = draw(differ)
expect_texts(svg, ["y: model does not describe it",
                   "x: described in part, left out 0.7 … 0.9 Hz; y: left out above 20 Hz; z: step at 600 s,",
                   "frozen 100 … 110 s", "0.00400",
                   "&lt; 6.0×10⁻⁵ ?", "2.0×10⁻⁴, 77 s", "°/√h", "left out",
                   "model and curve disagree", "model, pale where not fitted"], ["read at the dot", "N  0.00"])
lines = dashed(svg)
expect(len({colour for colour, _ in lines}) == 3, lines)
expect(sorted(opacity for _, opacity in lines) == [0.35] * 2 + [1] * 6, lines)  # y above; x below

band = plot_allan_files.Finding("x", "excluded", 0.5, 2)
expect(plot_allan.times(band) == (0.25, 1) and plot_allan.frequencies(band) == (0.5, 2), plot_allan.times(band))
above = plot_allan_files.Finding("x", "unused", 20, 50)
expect(plot_allan.times(above) == (0, 0.025), plot_allan.times(above))

# One axis, a Gauss-Markov bias: its curve, and the dot at its top.
markov = write("markov", {"x": 1}, [("x", "N", 1e-3, "detected", ""), ("x", "G", 1e-3, "detected", 10)])
svg = draw(markov)
expect(draw(markov) == svg, "another picture each time")
expect_texts(svg, ["G  0.0010 rad/s, 10 s", "its terms, read at the dot"], ["not detected"])
bias = plot_allan_files.Term("G", "detected", 1e-3, math.nan, "rad/s", 10, "adequate")
tau, top = plot_allan_terms.reading_point(bias)
expect(all(plot_allan_terms.gauss_markov_deviation(bias, t) <= top * (1 + 1e-6) for t in (tau * 0.9, tau, tau * 1.1)), tau)
for short in 0.0099, 0.0101:  # like a random walk of K = σ√(2/T), on both sides of where the formula changes
    walk = 1e-3 * math.sqrt(2 / 10 * short / 3)
    expect(abs(plot_allan_terms.gauss_markov_deviation(bias, short) / walk - 1) < 1e-3, short)

# The band of a density with two degrees of freedom is exponential.
(work / "spectrum.csv").write_text(f"{plot_allan_files.SPECTRUM}\ng,x,1,1,1,2,1\n", encoding="utf-8")
lower, upper = plot_allan_files.read_spectrum(work / "spectrum.csv")["g"]["x"][2:4, 0]
share = math.erf(1 / math.sqrt(2))
for side, exact in (lower, (1 + share) / 2), (upper, (1 - share) / 2):
    expect(abs(side * math.sqrt(-math.log(1 - exact)) - 1) < 0.01, lower, upper)

# What an earlier allan wrote.
for name in "spectrum.csv", "findings.csv":
    (alike / name).unlink()
rows = (alike / "noise.csv").read_text(encoding="utf-8").splitlines()
(alike / "noise.csv").write_text("\n".join(",".join(row.split(",")[:9]) for row in rows) + "\n", encoding="utf-8")
expect_texts(draw(alike), ["K  3.00×10⁻⁵ rad/s²/√Hz", "averaging time τ (s)"], ["frequency (Hz)", "imu"])


def refused(says, file, old, new):
    """One line."""
    path = differ / file
    text = path.read_text(encoding="utf-8")
    expect(old in text, file, "has no", old)
    path.write_text(text.replace(old, new, 1), encoding="utf-8")
    try:
        plot_allan.draw_folder(differ)
        expect(False, file, new, "is not refused")
    except plotting.Failure as failure:
        expect(str(failure).startswith(f"{path}:") and says in str(failure), failure)
    path.write_text(text, encoding="utf-8")


refused(":1: '#sensors,axis,", "curves.csv", "#sensor", "#sensors")
refused(":2: 2 columns, expected 7: sensor,axis,frequency [Hz]", "spectrum.csv", "gyroscope,x,50.0,", "gyroscope,x\ng,x,")
refused(":2: '-1', expected a positive number for tau", "curves.csv", ",1,0.01,", ",1,-1,")
refused(":2: used '2', expected one of 0, 1", "spectrum.csv", ",1\n", ",2\n")
refused(":2: status 'sure', expected one of detected, possible, absent", "noise.csv", ",detected,partial", ",sure,partial")
refused(":2: adequacy 'good', expected one of adequate, partial, ", "noise.csv", "detected,partial", "detected,good")
refused(":2: '0', expected a positive number for estimate", "noise.csv", ",1,0.001,", ",1,0,")
refused(": from 0.9 to 0.7, expected a span", "findings.csv", ",0.7,0.9,", ",0.9,0.7,")
refused(": no rows, expected sensor,axis,m", "curves.csv", (differ / "curves.csv").read_text(encoding="utf-8"), "")

# As a program: both pictures, or one line, exit code 2 and no picture.
def run(folder):
    return subprocess.run([sys.executable, support / "plot_allan.py", folder, "--output", "noise"], capture_output=True,
                          text=True)


result = run(differ)
expect(result.returncode == 0 and result.stdout + result.stderr == "", result)
expect(all((differ / f"noise.{form}").stat().st_size > 10000 for form in ("png", "svg")), "too small a picture")
(alike / "noise.csv").unlink()
result = run(alike)
expect(result.returncode == 2 and result.stderr == f"plot_allan.py: {alike}/noise.csv: No such file or directory\n", result)
expect(sorted(path.name for path in alike.iterdir()) == ["allan.svg", "curves.csv"], list(alike.iterdir()))

# SPDX-License-Identifier: MIT
"""What was measured, as the tables and plots ask for it."""
import math
import statistics

SCENES = {"hand_held": "hand-held", "drone": "drone", "wheeled_robot": "wheeled robot", "measured": "measured flight"}
GROUPS = {"SO3xR3": "SO(3) × R³", "SE3": "SE(3)"}
ORDERS = range(3, 9)

# A sample's noise of a good MEMS IMU: the densities of the ADIS16448's data sheet (presets::adis16448) at 200 Hz, the
# length of three axes. The error of a curve is good enough if it is at most SHARE of this noise.
RATE = 200
GYRO_NOISE = math.sqrt(3 * RATE) * 0.66 * math.pi / 180 / 60
ACCEL_NOISE = math.sqrt(3 * RATE) * 0.11 / 60
SHARE = 0.1

POINT_SCHEMES = ("Euler", "ZeroOrderHold", "Midpoint", "Trapezoid", "RungeKutta4", "RungeKutta4DoubleStep", "Magnus4")
INCREMENT_SCHEMES = ("UncorrectedIncrements", "RotationCorrectedIncrements", "TwoSampleIncrements",
                     "ThreeSampleIncrements")
GRADES = ("consumer", "industrial", "tactical")


def seconds_text(interval):
    return f"{interval:g}"


def choice_text(row):
    return f"{GROUPS[row['group']]}, order {row['order']:.0f}, knots {seconds_text(row['knot_interval'])} s"


def log_text(samples):
    return f"log of {samples:,.0f} samples".replace(",", " ")


def range_of(rows, name):
    """The smallest, the median and the largest time of a sample [ns] of all rows."""
    return (min(row[f"{name}ns_min"] for row in rows), statistics.median(row[f"{name}ns_median"] for row in rows),
            max(row[f"{name}ns_max"] for row in rows))


class Representation:
    """What the page needs of curves. `errors` has a row for each curve, `times` for each kind of curve and way to
    evaluate it: the knot interval hardly changes the time."""

    def __init__(self, errors, times):
        self.rows, self.all_times = errors, times
        self.scenes = [scene for scene in SCENES if any(row["scene"] == scene for row in errors)]
        self.intervals = sorted({row["knot_interval"] for row in errors}, reverse=True)

    @staticmethod
    def select(rows, wanted):
        return [row for row in rows if all(row[key] == value for key, value in wanted.items())]

    def find(self, **wanted):
        return self.select(self.rows, wanted)

    def one(self, **wanted):
        return self.find(**wanted)[0]

    def times(self, way, **wanted):
        """The smallest, the median and the largest time of a sample [ns], over all scenes and knot intervals."""
        row, = self.select(self.all_times, {"way": way, **wanted})
        return row["ns_min"], row["ns_median"], row["ns_max"]

    def time(self, way, interval, **wanted):
        """The smallest time of a sample [ns] with this knot interval, over all scenes."""
        row, = self.select(self.all_times, {"way": way, **wanted})
        return row[interval]

    @staticmethod
    def good_enough(row):
        return row["accel_rms"] <= SHARE * ACCEL_NOISE and row["gyro_rms"] <= SHARE * GYRO_NOISE

    def recommended(self, scene):
        """Of the curves in double that are good enough, those with the longest knots, of them the cheapest. None for a
        measured motion: its truth is a spline itself, so the errors show how alike two splines are."""
        rows = [row for row in self.find(scene=scene, scalar="double") if self.good_enough(row) and row["order"] >= 4]
        if not rows or scene == "measured":
            return None
        longest = max(row["knot_interval"] for row in rows)
        return min((row for row in rows if row["knot_interval"] == longest),
                   key=lambda row: self.times("dense", group=row["group"], order=row["order"], scalar="double")[0])

    def table_interval(self, scene):
        """The knot interval of the table of errors: the recommended one, or about 0.0125 s."""
        pick = self.recommended(scene)
        return pick["knot_interval"] if pick else min(self.intervals, key=lambda i: abs(i - 0.0125))


class Integrators:
    """What the page needs of integrators. `errors` has the RMS of the position error for each scene, grade of noise and
    rate: without noise ("none") of each scheme, with noise of the scheme that adds least to it ("best")."""

    def __init__(self, errors, times):
        self.scenes = [scene for scene in SCENES if any(row["scene"] == scene for row in errors)]
        self.rates = sorted({row["rate"] for row in errors})
        self.error = {(row["scene"], row["grade"], row["rate"], row["scheme"]): row["position_rms"] for row in errors}
        self.all_times = {row["scheme"]: (row["ns_min"], row["ns_median"], row["ns_max"]) for row in times}
        self.schemes = [scheme for scheme in (*POINT_SCHEMES, *INCREMENT_SCHEMES) if scheme in self.all_times]

    def times(self, scheme):
        """Of a sample, over all scenes and rates: what a scheme costs depends on neither."""
        return self.all_times[scheme]

    def floor(self, scene, grade, rate):
        """What noise alone does: the error of the scheme that adds least to it."""
        return self.error[scene, grade, rate, "best"]

    def cheapest(self, scene, grade, rate, schemes):
        """The cheapest scheme whose own error is below a tenth of the noise's."""
        good = [s for s in schemes if s in self.schemes
                and self.error[scene, "none", rate, s] <= SHARE * self.floor(scene, grade, rate)]
        return min(good, key=lambda s: self.times(s)[0], default=None)

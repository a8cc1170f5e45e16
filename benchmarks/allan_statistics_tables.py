# SPDX-License-Identifier: MIT
"""The tables of allan_statistics.py, and what it judges."""
import dataclasses
import math

import numpy as np
import scipy.stats

from allan_log_parts import Grid

LEAST_COVERAGE, MOST_COVERAGE = 0.92, 0.98  # of intervals of 95 %
LEAST_WARNED = 0.95                         # of the logs of which an interval does not cover
MOST_FALSE = 0.015
MOST_DEVIATIONS = 4                         # standard errors
MOST_OVER_BOUND = {"N": 1.05, "K": 1.13}


def cramer_rao(grid, white, walk):
    """The least standard errors of N and K over their values, from white noise and random walk together.

    The differences of the samples have the covariance K²/rate·1 + N²·rate·tridiag(−1, 2, −1). Its eigenvectors are
    sines, its eigenvalues K²/rate + 4N²·rate·sin²(πk/2n). A Gaussian of variance v says (dv/v)²/2 of what moves v.
    """
    k = np.arange(1, grid.samples)
    of_white = 4 * white**2 * grid.rate * np.sin(np.pi * k / (2 * grid.samples)) ** 2
    of_walk = np.full_like(of_white, walk**2 / grid.rate)
    shares = np.stack([2 * of_white, 2 * of_walk]) / (of_white + of_walk)  # d ln v / d ln N, d ln v / d ln K
    return dict(zip("NK", np.sqrt(np.diag(np.linalg.inv(shares @ shares.T / 2)))))


@dataclasses.dataclass
class Share:
    """How many of how many."""

    count: int
    total: int

    @property
    def value(self):
        return self.count / self.total if self.total else math.nan

    def verdict(self, least, most):
        """PASS inside the range; near if outside, but so far by chance in more than 1 of 40; else over."""
        if self.total == 0 or least <= self.value <= most:
            return "PASS"
        if self.value > most:
            chance = scipy.stats.binom.sf(self.count - 1, self.total, most)
        else:
            chance = scipy.stats.binom.cdf(self.count, self.total, least)
        return "near" if chance > 1 / 40 else "over"

    def __str__(self):
        return f"{100 * self.value:.1f} % of {self.total}" if self.total else "of 0"


def warned(row):
    """Whether the output says that the model does not describe the log."""
    return row["adequacy"] > 0


def terms_of(rows):
    return [name.removesuffix("_detected") for name in rows[0] if name.endswith("_detected")]


class Present:
    """What was found of a term that is in the logs."""

    def __init__(self, rows, term, bound):
        truth = np.array([row[f"truth_{term}"] for row in rows])
        columns = ("value", "lower", "upper", "one_sigma_lower", "one_sigma_upper")
        value, lower, upper, inner, outer = np.array([[row[f"{term}_{name}"] for row in rows] for name in columns])
        detected = np.array([row[f"{term}_detected"] == 1 for row in rows])
        warning = np.array([warned(row) for row in rows])
        covers = (lower <= truth) & (truth <= upper)
        self.detected = Share(detected.sum(), len(rows))
        self.coverage = Share((detected & covers).sum(), detected.sum())
        self.one_sigma = Share((detected & (inner <= truth) & (truth <= outer)).sum(), detected.sum())
        self.limits = Share((~detected & (truth <= upper)).sum(), (~detected).sum())
        self.missed_warned = Share((detected & ~covers & warning).sum(), (detected & ~covers).sum())
        ratio = value[detected] / truth[detected]
        self.mean, self.spread = (ratio.mean(), ratio.std(ddof=1)) if len(ratio) > 1 else (math.nan, math.nan)
        self.over_bound = (value / truth).std(ddof=1) / bound if bound else None

    def coverage_verdict(self):
        verdict = self.coverage.verdict(LEAST_COVERAGE, MOST_COVERAGE)
        return verdict if verdict == "PASS" or self.missed_warned.value < LEAST_WARNED else "PASS"

    def bound_verdict(self, term):
        """near: the scatter of a standard deviation of so many logs, 1/√(2 logs), explains it."""
        most = MOST_OVER_BOUND[term]
        if self.over_bound <= most:
            return "PASS"
        return "near" if self.over_bound <= most * (1 + 2 / math.sqrt(2 * self.detected.total)) else "over"


class Summary:
    """Of one case."""

    def __init__(self, rows, grid):
        self.name = rows[0]["case"]
        self.logs = len(rows)
        self.warnings = Share(sum(map(warned, rows)), len(rows))
        self.above, self.below = (
            Share(sum(row[column] > MOST_DEVIATIONS and not warned(row) for row in rows), len(rows))
            for column in ("model_above", "model_below"))
        whole = [row for row in rows if not warned(row) and row["highest_frequency"] >= row["rate"] / 2]
        self.whole_band = Share(
            sum(max(row["model_above"], row["model_below"]) > MOST_DEVIATIONS for row in whole), len(rows))
        self.seconds = np.median([row["seconds"] for row in rows])
        self.simulation_seconds = np.median([row["simulation_seconds"] for row in rows])
        self.present, self.absent = {}, {}
        truth = {term: rows[0].get(f"truth_{term}", 0) for term in terms_of(rows)}
        known = {name.removeprefix("truth_") for name in rows[0] if name.startswith("truth_")}
        ideal = known == {"N", "K"} and self.name.startswith("walk")
        bounds = cramer_rao(grid, truth["N"], truth["K"]) if ideal else {}
        for term, value in truth.items():
            if value > 0:
                self.present[term] = Present(rows, term, bounds.get(term))
            else:
                found = [row for row in rows if row[f"{term}_detected"] == 1]
                self.absent[term] = (Share(len(found), len(rows)), sum(not warned(row) for row in found))


def present_table(summaries):
    yield ("| case | warned | term | detected | 95 % covers | warned of those not covering | 1 sigma covers | "
           "limit holds, not detected | value/truth | std/bound | verdict |")
    yield "|---|---|---|---|---|---|---|---|---|---|---|"
    for summary in summaries:
        for term, found in summary.present.items():
            bound = f"{found.over_bound:.3f}" if found.over_bound else ""
            yield (f"| {summary.name} | {summary.warnings} | {term} | {found.detected} | {found.coverage} | "
                   f"{found.missed_warned} | {found.one_sigma} | {found.limits} | "
                   f"{found.mean:.4f} ± {found.spread:.4f} | {bound} | {found.coverage_verdict()} |")


def absent_table(summaries):
    terms = list(dict.fromkeys(term for summary in summaries for term in summary.absent))
    yield ("Found although not there, % of logs (of these without warning); and, without warning, % of logs whose "
           f"model is above or below the measured deviation by more than {MOST_DEVIATIONS} standard errors, and of "
           "these the logs that were used up to rate/2:\n")
    yield f"| case | logs | warned | {' | '.join(terms)} | above | below | used up to rate/2 | s | s to simulate |"
    yield "|---" * (len(terms) + 8) + "|"
    for summary in summaries:
        cells = []
        for term in terms:
            share, silent = summary.absent.get(term, (None, 0))
            if share is None:
                cells.append("")
            else:
                verdict = share.verdict(0, MOST_FALSE)
                cells.append(f"{100 * share.value:.1f} ({100 * silent / share.total:.1f})"
                             + ("" if verdict == "PASS" else f" {verdict}"))
        yield (f"| {summary.name} | {summary.logs} | {100 * summary.warnings.value:.1f} | {' | '.join(cells)} | "
               f"{100 * summary.above.value:.1f} | {100 * summary.below.value:.1f} | "
               f"{100 * summary.whole_band.value:.1f} | {summary.seconds:.3f} | {summary.simulation_seconds:.3f} |")


def verdict_table(summaries):
    """One line for each number asked for: PASS, or which cases are over it and which near it by chance."""
    groups = {
        f"95 % intervals cover {LEAST_COVERAGE:.0%} to {MOST_COVERAGE:.0%}, or a warning comes with {LEAST_WARNED:.0%} "
        "of those that don't":
            [(f"{s.name} {t}", p.coverage_verdict()) for s in summaries for t, p in s.present.items()],
        f"false detections ≤ {100 * MOST_FALSE:g} %":
            [(f"{s.name} {t}", a[0].verdict(0, MOST_FALSE)) for s in summaries for t, a in s.absent.items()],
        f"no model above the measured deviation by more than {MOST_DEVIATIONS} standard errors without warning":
            [(s.name, s.above.verdict(0, 0)) for s in summaries],
        f"no model below the measured deviation by more than {MOST_DEVIATIONS} standard errors without warning":
            [(s.name, s.below.verdict(0, 0)) for s in summaries],
    }
    for term, most in MOST_OVER_BOUND.items():
        groups[f"{term} ≤ {most:g} × Cramér–Rao on white noise and random walk"] = [
            (s.name, s.present[term].bound_verdict(term)) for s in summaries
            if term in s.present and s.present[term].over_bound]
    yield "| asked | verdict | over | near |"
    yield "|---|---|---|---|"
    for name, verdicts in groups.items():
        if not verdicts:
            continue
        over, near = ([what for what, verdict in verdicts if verdict == which] for which in ("over", "near"))
        verdict = "over" if over else "near" if near else "PASS"
        yield f"| {name} | {verdict}: {len(over)} of {len(verdicts)} over | {', '.join(over)} | {', '.join(near)} |"


def report(rows):
    grid = Grid(int(rows[0]["samples"]), rows[0]["rate"])
    cases = list(dict.fromkeys(row["case"] for row in rows))
    summaries = [Summary([row for row in rows if row["case"] == case], grid) for case in cases]
    tables = ("\n".join(table(summaries)) for table in (verdict_table, present_table, absent_table))
    return "\n\n".join([f"Logs of {grid.duration / 3600:g} h at {grid.rate:g} Hz.", *tables])

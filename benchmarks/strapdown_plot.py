#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws what `strapdown --csv` measured: error against nanoseconds a sample, a line for each scheme.

    strapdown --csv > strapdown.csv
    strapdown_plot.py strapdown.csv strapdown.svg        # needs matplotlib
"""
import argparse
import csv
import sys

NAMES = {
    "euler": "Euler",
    "zero_order_hold": "ZeroOrderHold",
    "midpoint": "Midpoint",
    "trapezoid": "Trapezoid",
    "runge_kutta4": "RungeKutta4 (linear)",
    "runge_kutta4_double_step": "RungeKutta4DoubleStep",
    "magnus4": "Magnus4",
    "uncorrected_increments": "UncorrectedIncrements",
    "rotation_corrected_increments": "RotationCorrectedIncrements",
    "two_sample_increments": "TwoSampleIncrements",
    "three_sample_increments": "ThreeSampleIncrements",
}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("figures", help="csv of the benchmark program strapdown: name,value,unit")
    parser.add_argument("picture", help="file to write: svg, png or pdf")
    arguments = parser.parse_args()
    with open(arguments.figures, newline="") as file:
        figures = {row[0]: float(row[1]) for row in csv.reader(file) if len(row) == 3}

    try:
        import matplotlib
    except ImportError:
        sys.exit("strapdown_plot.py: matplotlib is not installed")
    matplotlib.use("svg")
    import matplotlib.pyplot as plot
    import matplotlib.ticker
    import thin_svg

    figure, axes = plot.subplots(figsize=(9, 5.5))
    for index, (name, label) in enumerate(NAMES.items()):
        if f"ns_{name}" not in figures:
            sys.exit(f"strapdown_plot.py: {arguments.figures}: no figure ns_{name}")
        # Nanoseconds of work for one second of data: the price of a rate.
        points = [(figures[f"ns_{name}"] * rate / 1000, figures[f"error_{name}_{rate}_Hz"])
                  for rate in (100, 200, 400, 1000)]
        style = "--" if name.endswith("increments") else "-"
        axes.loglog(*zip(*points), style, marker="osD^v<>phX*"[index], color=f"C{index % 10}", label=label)
    axes.set_xticks([2, 5, 10, 20, 50], labels=["2", "5", "10", "20", "50"])
    axes.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    axes.set_xlabel("work for a second of data [µs], at 100, 200, 400 and 1000 Hz")
    axes.set_ylabel("largest position error in 10 s [m]")
    axes.set_title("What integration schemes cost and buy: up to 20.7 rad/s and 129 m/s²")
    axes.grid(True, which="both", alpha=0.25)
    axes.legend(fontsize="small", loc="lower left")
    figure.tight_layout()
    thin_svg.save(figure, arguments.picture)


if __name__ == "__main__":
    main()

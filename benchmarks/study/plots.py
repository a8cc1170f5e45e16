# SPDX-License-Identifier: MIT
"""What the plots of the study share."""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import thin_svg

# Okabe and Ito's colours, which colour-blind people tell apart.
BLACK, ORANGE, SKY, GREEN, BLUE, RED, PINK = "#000000 #E69F00 #56B4E9 #009E73 #0072B2 #D55E00 #CC79A7".split()
STAR = {"color": "white", "markeredgecolor": BLACK}


def set_style():
    plt.rcParams.update({"font.size": 9, "axes.titlesize": 10, "svg.hashsalt": "splinertia", "axes.grid": True,
                         "grid.alpha": 0.25, "lines.linewidth": 1.2, "legend.fontsize": 8,
                         "savefig.facecolor": "white"})


def save(figure, folder, name):
    for form in ("svg", "png"):
        thin_svg.save(figure, folder / f"{name}.{form}")
    plt.close(figure)


def front(points):
    """The points (x, y, …) that none other is better than in both."""
    best, result = np.inf, []
    for point in sorted(points, key=lambda p: (p[0], p[1])):
        if point[1] < best:
            best = point[1]
            result.append(point)
    return result


def panels(count, height=3.6):
    columns = 2 if count in (2, 4) else count
    rows = -(-count // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(9.5, height * rows), layout="constrained", squeeze=False)
    return figure, list(axes.flat)

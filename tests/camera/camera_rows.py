# SPDX-License-Identifier: MIT
"""What compare_opencv.py and compare_colmap.py share: this library's cameras, through the program camera_rows, and random
cameras, points and pixels."""

import pathlib
import subprocess
import sys

import numpy as np

program = sys.argv[1] if len(sys.argv) > 1 else "camera_rows"
size = (752, 480)
tolerance = 1e-9  # px
failures = []


def expect(condition, *what):
    if not condition:
        failures.append(what)
        print("FAILED:", *what)


def finish():
    sys.exit(1 if failures else 0)


def rows(model, task, parameters, values, width):
    """Of each row of values, what the program says; NaN where that is nothing."""
    start = " ".join([model, task, *(repr(float(p)) for p in parameters)])
    text = "".join(start + " " + " ".join(repr(float(x)) for x in row) + "\n" for row in values)
    run = subprocess.run([program], input=text, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"{pathlib.Path(program).name}: {run.stderr}")
    lines = run.stdout.splitlines()
    assert len(lines) == len(values)
    return np.array([[np.nan] * width if line == "nothing" else line.split() for line in lines], dtype=float)


def project_points(model, parameters, points):
    """The pixels of points, and which of them are in the domain."""
    pixels = rows(model, "project", parameters, points, 2)
    return pixels, ~np.isnan(pixels[:, 0])


def unproject_pixels(model, parameters, pixels):
    """The rays of pixels, the angle of a pixel there in radians, and which pixels have a ray."""
    both = rows(model, "unproject", parameters, pixels, 4)
    return both[:, :3], both[:, 3], ~np.isnan(both[:, 0])


def focal(random, f=460.0):
    return [f * random.uniform(0.5, 2), f * random.uniform(0.5, 2), random.uniform(300, 450), random.uniform(200, 280)]


def brown(random):
    """k1, k2, p1, p2, of which some turn back inside of the image."""
    return [random.uniform(-0.4, 0.2), random.uniform(-0.1, 0.15), *random.uniform(-2e-3, 2e-3, 2)]


def rational(random):
    """k1, k2, p1, p2, k3, k4, k5, k6."""
    return [*brown(random), random.uniform(-0.03, 0.03), random.uniform(-0.1, 0.3), *random.uniform(-0.02, 0.05, 2)]


def fisheye(random):
    """k1, k2, k3, k4, of which some turn back before 90 degrees."""
    return [*random.uniform(-0.08, 0.08, 2), *random.uniform(-0.02, 0.02, 2)]


def points(random, widest, count=1000):
    """Points of all distances, with angles from the optical axis up to `widest`, in degrees."""
    polar = np.radians(widest) * np.sqrt(random.uniform(0, 1, count))
    azimuth, distance = random.uniform(-np.pi, np.pi, count), 10 ** random.uniform(-2, 3, count)
    return distance[:, None] * np.column_stack(
        [np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)])


def some_pixels(random, count=1000):
    """Pixels of the image and of a border around it, half as large again."""
    return random.uniform([-0.25 * size[0], -0.25 * size[1]], [1.25 * size[0], 1.25 * size[1]], (count, 2))


def near(pixels):
    """Whether pixels are so close to the image that doubles can agree to the tolerance."""
    return np.all(np.abs(pixels) < 1e4, axis=1)


def distances(a, b):
    return np.linalg.norm(np.asarray(a) - np.asarray(b), axis=1)


def compare_shifted(peer, model, parameters, project):
    """A model that has no peer as a whole: its points are moved by xi |p| along the optical axis and then projected by
    another model, project(p, points), that has one. parameters(random) gives its parameters and xi."""
    random = np.random.default_rng(5)
    forward, again = [], []
    for _ in range(15):
        p, xi = parameters(random)
        move = lambda x: x + xi * np.linalg.norm(x, axis=1)[:, None] * np.array([0, 0, 1])
        x = points(random, 150)
        pixels, valid = project_points(model, p, x)
        valid &= near(pixels) & (move(x)[:, 2] > 0.01 * np.linalg.norm(x, axis=1))
        forward.append(distances(project(p, move(x)), pixels)[valid])
        pixels = some_pixels(random)
        rays, _, valid = unproject_pixels(model, p, pixels)
        valid &= move(rays)[:, 2] > 0.01
        again.append(distances(project(p, move(rays[valid])), pixels[valid]))
    report(peer, model, "project", np.concatenate(forward))
    report(peer, model, "its projection of our rays", np.concatenate(again))


def report(peer, model, what, errors):
    """Fails where an error is above the tolerance, and where nothing was compared."""
    worst = np.max(errors) if len(errors) else np.nan
    print(f"{peer:12} {model:16} {what:44} {len(errors):7} compared, largest difference {worst:.1e} px")
    expect(len(errors) > 100 and worst <= tolerance, peer, model, what, worst)


def report_outside(peer, model, points, normalised):
    """Says how far from points outside of the domain a peer finds them again, as (x/z, y/z), from the pixels that it makes
    of them."""
    back = np.column_stack([normalised, np.ones(len(points))])
    cosine = np.sum(back * points, axis=1) / np.linalg.norm(back, axis=1) / np.linalg.norm(points, axis=1)
    worst = np.max(np.arccos(np.clip(cosine, -1, 1)))
    print(f"{peer:12} {model:16} points outside of the domain come back up to {worst:.2f} rad away; we project none")

# SPDX-License-Identifier: MIT
"""Compares cameras with OpenCV's: compare_opencv.py CAMERA_ROWS

Within the domain both must agree to 1e-9 pixels. Outside of it OpenCV still answers; this library must not.
Exit code 77: OpenCV is not installed, nothing was checked.
"""

import sys

try:
    import cv2
    import numpy as np
except ImportError as error:
    print(f"skipped: the Python package {error.name} is not installed (pip install opencv-python-headless)")
    sys.exit(77)

import camera_rows
from camera_rows import distances, expect

peer = "OpenCV"
criteria = (3, 100, 1e-14)  # undistortPoints' own ends after 5 steps, 0.57 px from the solution
zero = np.zeros(3)


def matrix(p):
    return np.array([[p[0], 0, p[2]], [0, p[1], p[3]], [0, 0, 1.0]])


def image(p, points):
    return cv2.projectPoints(points, zero, zero, matrix(p), np.array(p[4:]))[0][:, 0]


def fisheye_image(p, points):
    return cv2.fisheye.projectPoints(points[:, None], zero, zero, matrix(p), np.array(p[4:]))[0][:, 0]


def undistorted(p, pixels):
    return cv2.undistortPoints(pixels[:, None], matrix(p), np.array(p[4:]), criteria=criteria)[:, 0]


def fisheye_undistorted(p, pixels):
    return cv2.fisheye.undistortPoints(pixels[:, None], matrix(p), np.array(p[4:]), criteria=criteria)[:, 0]


def compare(model, coefficients, project, undistort, widest):
    """Random cameras of a model, projection and inverse."""
    random = np.random.default_rng(7)
    forward, again, inverse = [], [], []
    wrong = 0
    for _ in range(15):
        p = camera_rows.focal(random) + list(coefficients(random))
        points = camera_rows.points(random, widest)
        pixels, valid = camera_rows.project_points(model, p, points)
        valid &= camera_rows.near(pixels)
        forward.append(distances(project(p, points), pixels)[valid])

        pixels = camera_rows.some_pixels(random)
        rays, angle, valid = camera_rows.unproject_pixels(model, p, pixels)
        front = valid & (rays[:, 2] > 0.01)  # OpenCV cannot project what is behind the camera
        again.append(distances(project(p, rays[front]), pixels[front]))

        # OpenCV's inverse where it has converged to a point of the domain
        theirs = np.column_stack([undistort(p, pixels), np.ones(len(pixels))])
        converged = distances(project(p, theirs), pixels) < 1e-10
        _, inside = camera_rows.project_points(model, p, theirs)
        both = converged & inside
        expect(np.all(valid[both]), model, "has no ray where OpenCV has one", p, pixels[both & ~valid])
        theirs /= np.linalg.norm(theirs, axis=1)[:, None]
        common = both & (angle < 0.01)  # close to the end of the domain 1e-10 px are not the same ray
        inverse.append((distances(theirs, rays) / angle)[common])
        wrong += np.count_nonzero(front & ~both)
    camera_rows.report(peer, model, "project", np.concatenate(forward))
    camera_rows.report(peer, model, "its projection of our rays", np.concatenate(again))
    camera_rows.report(peer, model, "undistortPoints, where it converges", np.concatenate(inverse))
    print(f"{peer:12} {model:16} pixels that it does not invert to 1e-10 px: {wrong}")


def outside(model, p, project, undistort, points, pixels):
    """Points and pixels outside of the domain. We have none; OpenCV has a pixel for each point, which is that of another."""
    _, valid = camera_rows.project_points(model, p, points)
    expect(not np.any(valid), model, "projects what is outside of its domain")
    _, _, valid = camera_rows.unproject_pixels(model, p, pixels)
    expect(not np.any(valid), model, "unprojects what no point of its domain has")
    camera_rows.report_outside(peer, model, points, undistort(p, project(p, points)))


def main():
    compare("pinhole-none", lambda random: [], lambda p, x: image([*p, 0, 0, 0, 0], x),
            lambda p, x: undistorted([*p, 0, 0, 0, 0], x), 89)
    compare("pinhole-radtan", camera_rows.brown, image, undistorted, 85)
    compare("pinhole-radtan8", camera_rows.rational, image, undistorted, 85)
    compare("pinhole-equi", camera_rows.fisheye, fisheye_image, fisheye_undistorted, 89)

    def omni(random):
        xi = random.uniform(0, 1.5)
        return [xi, *camera_rows.focal(random), *camera_rows.brown(random)], xi

    camera_rows.compare_shifted(peer, "omni-radtan", omni, lambda p, x: image(p[1:], x))

    # Radial distortion that turns back at |m| = 0.816 and 79.6 degrees.
    radtan = [458, 457, 367, 248, -0.5, 0, 0, 0]
    around = np.column_stack([np.cos(np.arange(0, 6, 0.1)), np.sin(np.arange(0, 6, 0.1))])
    outside("pinhole-radtan", radtan, image, undistorted, np.column_stack([0.9 * around, np.ones(60)]),
            np.array(radtan[2:4]) + 458 * 0.56 * around)
    equi = [300, 300, 320, 240, 0.02, -0.06, 0.0, 0.0]
    outside("pinhole-equi", equi, fisheye_image, fisheye_undistorted, np.column_stack([8 * around, np.ones(60)]),
            np.array(equi[2:4]) + 300 * 1.2 * around)
    camera_rows.finish()


main()

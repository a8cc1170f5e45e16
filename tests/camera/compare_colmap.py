# SPDX-License-Identifier: MIT
"""Compares cameras with COLMAP's: compare_colmap.py CAMERA_ROWS

Within the domain both must agree to 1e-9 pixels. Outside of it COLMAP still answers; this library must not.
Exit code 77: pycolmap is not installed, nothing was checked.
"""

import sys

try:
    import numpy as np
    import pycolmap
except ImportError as error:
    print(f"skipped: the Python package {error.name} is not installed (pip install pycolmap)")
    sys.exit(77)

import camera_rows
from camera_rows import distances, expect

peer = "COLMAP"


def camera(name, p):
    return pycolmap.Camera(model=name, width=camera_rows.size[0], height=camera_rows.size[1], params=list(map(float, p)))


def compare(model, name, coefficients, widest, closest=0):
    """Random cameras of a model, projection and inverse. Nothing is compared where |(x, y)| / z < closest."""
    if name not in pycolmap.CameraModelId.__members__:
        print(f"{peer:12} {model:16} this version has no {name}")
        return
    random = np.random.default_rng(11)
    forward, again, inverse = [], [], []
    inaccurate = 0
    for _ in range(15):
        p = camera_rows.focal(random) + list(coefficients(random))
        theirs = camera(name, p)
        points = camera_rows.points(random, widest)
        pixels, valid = camera_rows.project_points(model, p, points)
        image = theirs.img_from_cam(points, check_cheirality=False)
        radius = np.linalg.norm(points[:, :2], axis=1)
        valid &= camera_rows.near(pixels) & (points[:, 2] > 0) & (radius >= closest * points[:, 2])
        forward.append(distances(image, pixels)[valid])

        pixels = camera_rows.some_pixels(random)
        rays, angle, valid = camera_rows.unproject_pixels(model, p, pixels)
        front = valid & (rays[:, 2] > 0.01) & (np.linalg.norm(rays[:, :2], axis=1) >= closest * rays[:, 2])
        again.append(distances(theirs.img_from_cam(rays[front], check_cheirality=False), pixels[front]))

        # COLMAP's inverse where it has converged to a point of the domain
        bearing = np.column_stack([theirs.cam_from_img(pixels), np.ones(len(pixels))])
        bearing[~np.all(np.isfinite(bearing), axis=1)] = [0, 0, -1]
        converged = distances(theirs.img_from_cam(bearing, check_cheirality=False), pixels) < 1e-10
        _, inside = camera_rows.project_points(model, p, bearing)
        both = converged & inside
        expect(np.all(valid[both]), model, "has no ray where COLMAP has one", p, pixels[both & ~valid])
        bearing /= np.linalg.norm(bearing, axis=1)[:, None]
        common = both & front & (angle < 0.01)  # close to the end of the domain 1e-10 px are not the same ray
        inverse.append((distances(bearing, rays) / angle)[common])
        inaccurate += np.count_nonzero(front & ~both)
    camera_rows.report(peer, model, "img_from_cam", np.concatenate(forward))
    camera_rows.report(peer, model, "its projection of our rays", np.concatenate(again))
    camera_rows.report(peer, model, "cam_from_img, where it converges", np.concatenate(inverse))
    print(f"{peer:12} {model:16} pixels that it inverts less accurately than 1e-10 px: {inaccurate}")


def outside(model, name, p, points, pixels):
    """Points and pixels outside of the domain. We have none; COLMAP has a pixel for each point, which is that of another."""
    theirs = camera(name, p)
    _, valid = camera_rows.project_points(model, p, points)
    expect(not np.any(valid), model, "projects what is outside of its domain")
    _, _, valid = camera_rows.unproject_pixels(model, p, pixels)
    expect(not np.any(valid), model, "unprojects what no point of its domain has")
    camera_rows.report_outside(peer, model, points, theirs.cam_from_img(theirs.img_from_cam(points)))


def main():
    compare("pinhole-none", "PINHOLE", lambda random: [], 89)
    compare("pinhole-radtan", "OPENCV", camera_rows.brown, 85)
    compare("pinhole-radtan8", "FULL_OPENCV", camera_rows.rational, 85)
    compare("pinhole-equi", "OPENCV_FISHEYE", camera_rows.fisheye, 89)
    # Below a radius of 0.01 COLMAP takes two terms of a series, which is 7e-8 px off.
    compare("fov", "FOV", lambda random: [random.uniform(0.05, 1.5)], 89, 0.011)
    compare("eucm-none", "EUCM", lambda random: [random.uniform(0, 0.95), random.uniform(0.4, 2)], 89)

    def double_sphere(random):
        xi = random.uniform(-0.3, 0.5)
        return [*camera_rows.focal(random), xi, random.uniform(0, 0.95)], xi

    if "EUCM" in pycolmap.CameraModelId.__members__:
        camera_rows.compare_shifted(peer, "ds-none", double_sphere, lambda p, x: camera(
            "EUCM", [*p[:4], p[5], 1]).img_from_cam(x, check_cheirality=False))

    # Radial distortion that turns back at |m| = 0.816 and 79.6 degrees.
    radtan = [458, 457, 367, 248, -0.5, 0, 0, 0]
    around = np.column_stack([np.cos(np.arange(0, 6, 0.1)), np.sin(np.arange(0, 6, 0.1))])
    outside("pinhole-radtan", "OPENCV", radtan, np.column_stack([0.9 * around, np.ones(60)]),
            np.array(radtan[2:4]) + 458 * 0.56 * around)
    equi = [300, 300, 320, 240, 0.02, -0.06, 0.0, 0.0]
    outside("pinhole-equi", "OPENCV_FISHEYE", equi, np.column_stack([8 * around, np.ones(60)]),
            np.array(equi[2:4]) + 300 * 1.2 * around)
    camera_rows.finish()


main()

// SPDX-License-Identifier: MIT
// The headers after others that define macros: windows.h (min, max, near, far), complex.h (I), Arduino's. Whatever
// Eigen, Sophus or the standard library do not bear is not here; headers that the macros would break go before them.
#include <complex.h>

#include <Eigen/Dense>
#include <algorithm>
#include <chrono>
#include <iomanip>
#include <iostream>
#include <locale>
#include <random>
#include <ranges>
#include <sophus/se2.hpp>
#include <sophus/se3.hpp>
#include <vector>

#include "support/catch.hpp"

#ifndef I
#define I (__extension__ 1.0iF)
#endif
#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))
#define near
#define far
#define interface struct
#define pascal
#define cdecl
#define IN
#define OUT
#define OPTIONAL
#define CONST const
#define DELETE 1
#define ERROR 0
#define OK 0
#define ABSOLUTE 1
#define RELATIVE 2
#define DIFFERENCE 11
#define TRUE 1
#define FALSE 0
#define True 1
#define False 0
#define None 0L
#define Bool int
#define Status int
#define Always 2
#define Unsorted 0
#define B0 0
#define B1 1
#define B50 1
#define PI 3.14159
#define TWO_PI 6.28318
#define HALF_PI 1.57080
#define DEG_TO_RAD 0.01745
#define HIGH 1
#define LOW 0
#define INPUT 0
#define OUTPUT 1
#define sq(x) ((x) * (x))
#define radians(x) (x)
#define degrees(x) (x)
#define constrain(x, low, high) (x)
#define signals public
#define slots
#define emit
#define foreach for

#include <splinertia/calibration/inertial_fit.hpp>
#include <splinertia/splinertia.hpp>
#include <splinertia/strapdown/integrate.hpp>
#include <splinertia/strapdown/schemes/magnus4.hpp>

TEST_CASE("The headers bear the macros of others") {
  const splinertia::Spline<Eigen::Vector2d, 4> curve({.start = 0, .interval = 0.1},
                                                     std::vector<Eigen::Vector2d>(8, Eigen::Vector2d(1, 2)));
  CHECK(curve.at<1>(0.2).value.isApprox(Eigen::Vector2d(1, 2)));
}

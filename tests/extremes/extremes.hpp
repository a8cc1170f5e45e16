// SPDX-License-Identifier: MIT
/// Curves at the ends of what numbers can hold, judged against the same curve in long double.
///
/// The control points, as they are in Scalar, are the exact input, and are widened. Where a quaternion turns a vector
/// it is first brought to unit length, in long double; the angle between two does not ask for that, and must not,
/// because the rounding would be more than all of a small angle. An error is given as C, in
///
///   error ≤ C eps (natural size + |reference|)
///
/// where the natural size is what the terms of the sum that is computed amount to, before they cancel, each weighed
/// with the largest of the basis functions (of which all have the same error: u is rounded). That is grade A of
/// golden/golden_grade.hpp, but for those weights, and so is the limit: C of one rounding is 1/2, of an increment and
/// an exp 2 to 3 each, and they add up along Order − 1 factors mostly at random; what loses digits has a C of 100 and
/// more. What is measured is printed; docs/numerics.md has it in a table. A curve in long double is compared with
/// itself, almost: of it, only the lengths and that nothing is NaN are checked here, and its digits in golden/.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>
#include <splinertia/group/pose.hpp>
#include <splinertia/motion/motion.hpp>
#include <splinertia/spline/spline.hpp>
#include <string>
#include <type_traits>
#include <vector>

#include "support/catch.hpp"
#include "support/random_group.hpp"

namespace extremes {

using namespace splinertia::detail;

using Long = long double;
template <int N>
using LongVector = Eigen::Matrix<Long, N, 1>;

inline constexpr double limit = 4;

template <typename Scalar>
inline constexpr const char* scalar_name = std::is_same_v<Scalar, float>    ? "float"
                                           : std::is_same_v<Scalar, double> ? "double"
                                                                            : "long double";

template <typename Scalar>
inline constexpr Long eps = std::numeric_limits<Scalar>::epsilon();

/// Errors below this are underflow of intermediate products.
template <typename Scalar>
inline constexpr Long underflow = Long(std::numeric_limits<Scalar>::min()) / eps<Scalar>;

/// Where the rotation and the translation are in a tangent; `rigid` where rotations move the translation; the same
/// group in long double, and an element of it with the same numbers.
template <typename G>
struct Layout;

template <typename Scalar>
struct Layout<Sophus::SO2<Scalar>> {
  static constexpr const char* name = "SO2";
  static constexpr int rotation = 0, rotations = 1, translation = 0, translations = 0;
  static constexpr bool rigid = false;
  using Wide = Sophus::SO2<Long>;
  static Wide widen(const Sophus::SO2<Scalar>& x) {
    return splinertia::detail::rotation_from_unit_complex<Long>(x.unit_complex().x(), x.unit_complex().y());
  }
};

template <typename Scalar>
struct Layout<Sophus::SO3<Scalar>> {
  static constexpr const char* name = "SO3";
  static constexpr int rotation = 0, rotations = 3, translation = 0, translations = 0;
  static constexpr bool rigid = false;
  using Wide = Sophus::SO3<Long>;
  static Wide widen(const Sophus::SO3<Scalar>& x) {
    return splinertia::rotation_from_unit_quaternion<Long>(x.unit_quaternion().template cast<Long>());
  }
};

template <typename Scalar>
struct Layout<Sophus::SE2<Scalar>> {
  static constexpr const char* name = "SE2";
  static constexpr int rotation = 2, rotations = 1, translation = 0, translations = 2;
  static constexpr bool rigid = true;
  using Wide = Sophus::SE2<Long>;
  static Wide widen(const Sophus::SE2<Scalar>& x) {
    Wide y;
    y.so2() = Layout<Sophus::SO2<Scalar>>::widen(x.so2());
    y.translation() = x.translation().template cast<Long>();
    return y;
  }
};

template <splinertia::Pose G>
struct Layout<G> {
  using Scalar = splinertia::ScalarOf<G>;
  static constexpr bool rigid = splinertia::detail::RigidPose<G>;
  static constexpr const char* name = rigid ? "SE3" : "SO3xR3";
  static constexpr int rotation = rigid ? 3 : 0, rotations = 3, translation = rigid ? 0 : 3, translations = 3;
  using Wide = std::conditional_t<rigid, Sophus::SE3<Long>, splinertia::SO3xR3<Long>>;
  static Wide widen(const G& x) {
    return splinertia::make_pose<Wide>(Layout<Sophus::SO3<Scalar>>::widen(splinertia::rotation(x)),
                                       splinertia::position(x).template cast<Long>());
  }
};

template <typename G>
using Wide = typename Layout<G>::Wide;

template <typename G>
splinertia::Motion<Wide<G>, 3> widen(const splinertia::Motion<G, 3>& m) {
  splinertia::Motion<Wide<G>, 3> wide;
  wide.value = Layout<G>::widen(m.value);
  wide.velocity = m.velocity.template cast<Long>();
  wide.acceleration = m.acceleration.template cast<Long>();
  wide.jerk = m.jerk.template cast<Long>();
  return wide;
}

// From here on everything is in long double, W being SO2, SO3, SE2, SE3 or SO3xR3 of it.

/// The complex number or quaternion of the rotation.
template <typename W>
auto& rotation_numbers(W& x) {
  if constexpr (requires { x.so3(); }) {
    return rotation_numbers(x.so3());
  } else if constexpr (requires { x.so2(); }) {
    return rotation_numbers(x.so2());
  } else if constexpr (requires { x.template get<0>(); }) {
    return rotation_numbers(x.template get<0>());
  } else {
    return *x.data();
  }
}

template <typename W>
auto rotation_vector(const W& x) {
  constexpr int n = Layout<W>::rotations == 1 ? 2 : 4;
  return Eigen::Map<const LongVector<n>>(&rotation_numbers(x));
}

template <typename W>
W unit(W x) {
  constexpr int n = Layout<W>::rotations == 1 ? 2 : 4;
  Eigen::Map<LongVector<n>>(&rotation_numbers(x)).normalize();
  return x;
}

template <typename W>
LongVector<3> place(const W& x) {
  if constexpr (Layout<W>::translations == 2) {
    return {x.translation().x(), x.translation().y(), 0};
  } else if constexpr (Layout<W>::translations == 3) {
    return splinertia::position(x);
  } else {
    return {0, 0, 0};
  }
}

template <typename W>
auto turning(const splinertia::Tangent<W>& tau) {
  return LongVector<Layout<W>::rotations>(tau.template segment<Layout<W>::rotations>(Layout<W>::rotation));
}

template <typename W>
auto moving(const splinertia::Tangent<W>& tau) {
  return LongVector<Layout<W>::translations>(tau.template segment<Layout<W>::translations>(Layout<W>::translation));
}

/// log(x⁻¹ y): the rotation of the quaternions as they are, the translation turned by that of unit length.
template <typename W>
splinertia::Tangent<W> wide_increment(const W& x, const W& y) {
  splinertia::Tangent<W> d = splinertia::increment<W>(unit(x), unit(y));
  const splinertia::Tangent<W> raw = splinertia::increment<W>(x, y);
  d.template segment<Layout<W>::rotations>(Layout<W>::rotation) = turning<W>(raw);
  return d;
}

/// The largest C of value, velocity, acceleration and jerk, and the largest | |q|/|q₀| − 1 | in eps, where q₀ is the
/// first control point.
class Worst {
 public:
  void add(std::size_t quantity, Long error, Long size, Long scalar_eps, Long floor) {
    double c = 0;
    if (!(error <= floor)) c = static_cast<double>((error - floor) / (scalar_eps * size));  // NaN stays
    if (!(c <= c_[quantity])) c_[quantity] = c;
  }
  void add_length(Long length, Long scalar_eps) {
    const double c = static_cast<double>(std::abs(length - 1) / scalar_eps);
    if (!(c <= length_)) length_ = c;
  }
  /// Prints a line and holds every C to the limit.
  void require(const std::string& what, double largest = limit) const {
    INFO(what << ": value " << c_[0] << ", velocity " << c_[1] << ", acceleration " << c_[2] << ", jerk " << c_[3]
              << ", length " << length_);
    std::printf("%-44s value %4.2f  velocity %4.2f  acceleration %4.2f  jerk %4.2f  length %4.2f\n", what.c_str(),
                c_[0], c_[1], c_[2], c_[3], length_);
    for (const double c : c_) CHECK(c <= largest);
    CHECK(length_ <= largest);
  }

 private:
  std::array<double, 4> c_{};
  double length_ = 0;
};

/// A curve at one time, and the natural sizes of its value and derivatives.
template <typename W>
struct Reference {
  splinertia::Motion<W, 3> motion;
  std::array<Long, 4> rotation{}, translation{};
};

/// lambda[m] points at d^mλ_1/dt^m, d^mλ_2/dt^m, …
template <typename W>
void natural_sizes(Reference<W>& reference, const W& first, std::span<const splinertia::Tangent<W>> increments,
                   const std::array<const Long*, 4>& lambda) {
  constexpr bool rigid = Layout<W>::rigid;
  std::array<Long, 4> w{}, v{};  // max |d^mλ_j/dt^m| Σ |φ_j|, and the same of the translation
  Long reach = 0;
  for (const auto& d : increments) reach += moving<W>(d).stableNorm();
  for (std::size_t m = 0; m < 4; ++m) {
    Long weight = 0;
    for (std::size_t j = 0; j < increments.size(); ++j) weight = std::max(weight, std::abs(lambda[m][j]));
    for (const auto& d : increments) {
      const Long angle = turning<W>(d).stableNorm();
      w[m] += weight * angle;
      v[m] += weight * (moving<W>(d).stableNorm() + (rigid ? reach * angle : 0));
    }
  }
  reference.rotation = {1 + w[0], w[1], w[2] + w[1] * w[1], w[3] + 3 * w[1] * w[2] + w[1] * w[1] * w[1]};
  reference.translation = {place(first).norm() + v[0], v[1], v[2], v[3]};
  if (rigid) {
    reference.translation[2] += 2 * w[1] * v[1];
    reference.translation[3] += 3 * (w[1] * v[2] + v[1] * w[2]) + 3 * w[1] * w[1] * v[1];
  }
}

/// The curve from its increments.
template <int Order, typename W>
Reference<W> reference_from(const W& first, const std::array<splinertia::Tangent<W>, Order - 1>& increments,
                            const splinertia::CumulativeBasis<Long, Order, 3>& basis) {
  Reference<W> reference;
  reference.motion =
      splinertia::detail::evaluate_increments<3>(unit(first), [&](std::size_t j) { return increments[j]; }, basis);
  const auto& lambda = basis.lambda;
  natural_sizes<W>(reference, first, increments,
                   {lambda[0].data(), lambda[1].data(), lambda[2].data(), lambda[3].data()});
  return reference;
}

/// The curve from its control points.
template <int Order, typename W>
Reference<W> reference_from(const std::array<W, Order>& points,
                            const splinertia::CumulativeBasis<Long, Order, 3>& basis) {
  std::array<splinertia::Tangent<W>, Order - 1> increments;
  for (std::size_t j = 0; j < increments.size(); ++j) increments[j] = wide_increment(points[j], points[j + 1]);
  return reference_from<Order>(points[0], increments, basis);
}

/// Adds how far `got`, computed in a scalar of this eps, is from the reference.
template <typename W>
void compare(Worst& worst, const splinertia::Motion<W, 3>& got, const Reference<W>& reference, Long scalar_eps,
             Long floor) {
  const auto& gold = reference.motion;
  const auto add = [&](std::size_t quantity, const auto& a, const auto& b, Long size) {
    const Long error = a.array().isFinite().all() ? Long((a - b).template lpNorm<Eigen::Infinity>())
                                                  : std::numeric_limits<Long>::quiet_NaN();
    worst.add(quantity, error, size + b.template lpNorm<Eigen::Infinity>(), scalar_eps, floor);
  };
  const auto turn = turning<W>(splinertia::increment<W>(gold.value, unit(got.value)));
  add(0, turn, (turn * 0).eval(), reference.rotation[0]);
  add(1, turning<W>(got.velocity), turning<W>(gold.velocity), reference.rotation[1]);
  add(2, turning<W>(got.acceleration), turning<W>(gold.acceleration), reference.rotation[2]);
  add(3, turning<W>(got.jerk), turning<W>(gold.jerk), reference.rotation[3]);
  if constexpr (Layout<W>::translations > 0) {
    add(0, place(got.value), place(gold.value), reference.translation[0]);
    add(1, moving<W>(got.velocity), moving<W>(gold.velocity), reference.translation[1]);
    add(2, moving<W>(got.acceleration), moving<W>(gold.acceleration), reference.translation[2]);
    add(3, moving<W>(got.jerk), moving<W>(gold.jerk), reference.translation[3]);
  }
}

/// Adds how far what `got` is, computed from the Order control points from `points` on, from the reference.
template <int Order, typename G>
void compare_points(Worst& worst, const splinertia::Motion<G, 3>& got, const G* points,
                    const splinertia::CumulativeBasis<Long, Order, 3>& basis) {
  using Scalar = splinertia::ScalarOf<G>;
  std::array<Wide<G>, Order> wide;
  for (std::size_t i = 0; i < wide.size(); ++i) wide[i] = Layout<G>::widen(points[i]);
  const auto m = widen<G>(got);
  worst.add_length(rotation_vector(m.value).norm() / rotation_vector(wide[0]).norm(), eps<Scalar>);
  compare<Wide<G>>(worst, m, reference_from<Order>(wide, basis), eps<Scalar>, underflow<Scalar>);
}

/// Adds how far a curve is from its reference at t.
template <int Order, typename G, typename K>
void compare_at(Worst& worst, const splinertia::Spline<G, Order, K>& curve, typename K::Time t) {
  const auto& points = curve.control_points();
  const auto place = curve.knots().template basis<Long, Order, 3>(t, points.size());
  compare_points<Order>(worst, curve.template evaluate<3>(t), &points[place.first], place.basis);
}

/// The same at both ends of its domain and in between.
template <int Order, typename G, typename K>
void compare_curve(Worst& worst, const K& knots, const std::vector<G>& points) {
  const splinertia::Spline<G, Order, K> curve(knots, points);
  const auto start = curve.start(), end = curve.end();
  const auto length = end - start;
  for (const auto t : {start, start + length / 3, start + length / 2, start + length / 7 * 5, end}) {
    compare_at<Order>(worst, curve, t);
  }
}

/// The same of the function on spans, over all segments, at both ends and in the middle of each.
template <int Order, typename G>
void compare_segments(Worst& worst, Long interval, const std::vector<G>& points) {
  using Scalar = splinertia::ScalarOf<G>;
  for (std::size_t i = 0; i + Order <= points.size(); ++i) {
    for (const Scalar u : {Scalar(0), Scalar(0.3L), Scalar(0.5L), Scalar(1)}) {
      const auto rounded = static_cast<Scalar>(interval);
      const auto basis = splinertia::uniform_basis<Order, 3>(u, rounded);
      compare_points<Order>(worst, splinertia::evaluate<3>(std::span<const G, Order>(&points[i], Order), basis),
                            &points[i], splinertia::uniform_basis<Order, 3>(Long(u), Long(rounded)));
    }
  }
}

/// f<Order>() for the orders that are tested.
void for_orders(const auto& f) {
  f.template operator()<2>();
  f.template operator()<3>();
  f.template operator()<4>();
  f.template operator()<6>();
}

}  // namespace extremes

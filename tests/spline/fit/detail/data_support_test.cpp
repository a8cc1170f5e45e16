// SPDX-License-Identifier: MIT
#include <Eigen/Dense>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <splinertia/group/euclidean.hpp>
#include <splinertia/spline/fit/detail/data_support.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>
#include <splinertia/spline/uniform_knots.hpp>
#include <vector>

#include "support/catch.hpp"
#include "support/random_group.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

using Number = Eigen::Matrix<double, 1, 1>;
template <int Order>
using Even = Spline<Number, Order>;
template <int Order>
using Free = Spline<Number, Order, NonUniformKnots<double>>;

constexpr auto all = [](std::size_t) { return true; };

template <typename Curve>
PosesOf<Curve> at_times(const std::vector<double>& times) {
  PosesOf<Curve> poses;
  for (const double time : times) poses.push_back({time, Number(0)});
  return poses;
}

std::vector<double> spread(double from, double to, double step) {
  std::vector<double> times;
  for (double t = from; t <= to + 1e-12; t += step) times.push_back(std::min(t, to));
  return times;
}

using Points = std::vector<std::size_t>;

/// The smallest singular value of the weights of the determined control points at the poses, each column scaled to a
/// largest entry of one.
template <typename Curve>
double least_singular_value(const KnotsOf<Curve>& knots, std::size_t control_points, const PosesOf<Curve>& poses,
                            const Points& undetermined) {
  Eigen::MatrixXd weights =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(poses.size()), static_cast<Eigen::Index>(control_points));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto place = knots.template basis<double, Curve::order, 0>(poses[i].time, control_points);
    const auto row = control_point_weights(place.basis);
    for (std::size_t j = 0; j < row.size(); ++j) {
      weights(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(place.first + j)) = row[j];
    }
  }
  Eigen::MatrixXd determined(weights.rows(), 0);
  for (std::size_t j = 0; j < control_points; ++j) {
    if (std::binary_search(undetermined.begin(), undetermined.end(), j)) continue;
    determined.conservativeResize(Eigen::NoChange, determined.cols() + 1);
    const Eigen::VectorXd column = weights.col(static_cast<Eigen::Index>(j));
    determined.col(determined.cols() - 1) = column / column.maxCoeff();
  }
  return determined.cols() == 0 ? 1 : Eigen::JacobiSVD<Eigen::MatrixXd>(determined).singularValues().minCoeff();
}

}  // namespace

TEST_CASE("Weights of control points are those of the curve, and sum to one") {
  const UniformKnots<double> knots{0, 0.5};
  const auto place = knots.basis<double, 4, 0>(0.65, 9);
  const auto weights = control_point_weights(place.basis);
  double sum = 0;
  for (std::size_t j = 0; j < weights.size(); ++j) {
    std::vector<Number> points(9, Number(0));
    points[place.first + j] = Number(1);
    CHECK_THAT(weights[j], WithinAbs(Even<4>(knots, points).evaluate<0>(0.65).value[0], 1e-15));
    sum += weights[j];
  }
  CHECK_THAT(sum, WithinAbs(1, 1e-15));
}

TEST_CASE("Dense data determine every control point") {
  const auto check = [&]<int Order>() {
    INFO("order " << Order);
    const UniformKnots<double> even{0, 1};
    const auto poses = at_times<Even<Order>>(spread(0, 20, 0.25));
    CHECK(undetermined_control_points<Even<Order>>(even, 20 + Order - 1, poses, all).empty());

    NonUniformKnots<double> free{std::vector<double>(Order, 0.0)};
    for (double knot = 0.3; knot < 19; knot += knot < 10 ? 0.6 : 2.1) free.knots.push_back(knot);
    free.knots.insert(free.knots.end(), Order, 20.0);
    CHECK(undetermined_control_points<Free<Order>>(free, free.knots.size() - Order, poses, all).empty());
  };
  check.operator()<2>();
  check.operator()<3>();
  check.operator()<4>();
  check.operator()<6>();
  check.operator()<8>();
}

TEST_CASE("The control points of a gap are told") {
  using Curve = Even<4>;
  const UniformKnots<double> knots{0, 1};
  // Control point i shapes (i − 3, i + 1): from 6 to 12.5, i = 9 … 11 alone see nothing at all. The pose at 6 has a
  // quarter of the largest share of i = 8; of i = 12 those from 12.5 on have no more than 3 %, which is too little.
  auto times = spread(0, 6, 0.25);
  for (const double t : spread(12.5, 20, 0.25)) times.push_back(t);
  const auto poses = at_times<Curve>(times);
  const auto undetermined = undetermined_control_points<Curve>(knots, 23, poses, all);
  CHECK(undetermined == Points{9, 10, 11, 12});

  // Poses that do not count are none.
  const auto dense = at_times<Curve>(spread(0, 20, 0.25));
  const auto outside = [&](std::size_t i) { return dense[i].time <= 6 || dense[i].time >= 12.5; };
  CHECK(undetermined_control_points<Curve>(knots, 23, dense, outside) == undetermined);
}

TEST_CASE("Too few poses, though everywhere, leave some control points") {
  using Curve = Even<4>;
  const UniformKnots<double> knots{0, 1};
  const auto sparse = at_times<Curve>(spread(0, 20, 2.5));  // 9 for 23 control points
  const auto undetermined = undetermined_control_points<Curve>(knots, 23, sparse, all);
  CHECK(undetermined.size() == 23 - 9);
  CHECK(std::is_sorted(undetermined.begin(), undetermined.end()));
  CHECK(undetermined_control_points<Curve>(knots, 23, PosesOf<Curve>{}, all).size() == 23);
}

TEST_CASE("What is left is well determined") {
  testing::Random random(3);
  const auto check = [&]<int Order>(double floor) {
    INFO("order " << Order);
    const UniformKnots<double> even{0, 1};
    for (int trial = 0; trial < 40; ++trial) {
      std::vector<double> times;
      for (double t = 0; t < 15; t += random.symmetric() < -0.8 ? 4 : 0.2 + 0.1 * random.symmetric())
        times.push_back(t);
      const auto poses = at_times<Even<Order>>(times);
      const Points undetermined = undetermined_control_points<Even<Order>>(even, 14 + Order, poses, all);
      CHECK(least_singular_value<Even<Order>>(even, 14 + Order, poses, undetermined) > floor);
    }
  };
  // Full rank is what is promised. How far from singular depends on the order as the basis itself does: the poses of
  // one segment alone, all on its polynomial.
  check.operator()<2>(1e-2);
  check.operator()<4>(1e-3);
  check.operator()<6>(1e-6);
}

TEST_CASE("Nanoseconds and seconds leave the same undetermined") {
  using Curve = Even<4>;
  using Epoch = Spline<Number, 4, UniformKnots<nanoseconds>>;
  auto times = spread(0, 3, 0.2);
  for (const double t : spread(9, 12, 0.2)) times.push_back(t);
  PosesOf<Epoch> poses;
  const nanoseconds epoch{1'403'715'524'907'143'168};
  for (const double t : times) poses.push_back({epoch + nanoseconds{std::llround(t * 1e9)}, Number(0)});
  const auto expected = undetermined_control_points<Curve>({0, 1}, 15, at_times<Curve>(times), all);
  CHECK_FALSE(expected.empty());
  CHECK(undetermined_control_points<Epoch>({epoch, nanoseconds{1'000'000'000}}, 15, poses, all) == expected);
}

TEST_CASE("Thinly measured are control points with at most 5/4 poses a segment, and none at the ends") {
  using Curve = Even<4>;
  const UniformKnots<double> knots{0, 1};
  const auto thin = [&](const std::vector<double>& times) {
    return thinly_measured_control_points<Curve>(knots, 23, at_times<Curve>(times), all);
  };
  CHECK(thin(spread(0, 20, 0.5)).empty());
  CHECK(thin(spread(0, 20, 0.64)).empty());  // six in four segments
  Points inner;
  for (std::size_t i = 3; i < 20; ++i) inner.push_back(i);
  CHECK(thin(spread(0, 20, 0.85)) == inner);
  CHECK(thin(spread(0.5, 20, 1)) == inner);  // in the middle of every segment
  // From 8 to 14 there is one a segment: i shapes (i − 3, i + 1) and sees five of them or fewer.
  auto times = spread(0, 8, 0.25);
  for (const double t : spread(9, 13, 1)) times.push_back(t);
  for (const double t : spread(14, 20, 0.25)) times.push_back(t);
  CHECK(thin(times) == Points{11, 12, 13});
  const auto poses = at_times<Curve>(spread(0, 20, 0.25));
  const auto half = [](std::size_t i) { return i % 4 == 0; };
  CHECK(thinly_measured_control_points<Curve>(knots, 23, poses, half) == inner);
}

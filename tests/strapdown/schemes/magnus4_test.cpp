// SPDX-License-Identifier: MIT
#include <array>
#include <splinertia/strapdown/schemes/magnus4.hpp>
#include <splinertia/strapdown/schemes/midpoint.hpp>

#include "strapdown/schemes/convergence.hpp"
#include "strapdown/stamp_patterns.hpp"
#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("Magnus4 converges with order 4, whatever the intervals") {
  testing::check_order<Magnus4>(4, testing::regular_stamps);
  testing::check_order_of_unequal_intervals<Magnus4>(4);
  CHECK(testing::aggressive_error<Magnus4>(testing::regular_stamps(200)) < 1.55e-3);
}

TEST_CASE("The first and the last step of Magnus4 have an error of order 5, as every other has one") {
  // Four samples make three steps: the first, one in the middle, the last.
  const testing::AggressiveMotion<> motion;
  const auto errors = [&](double h) {
    const std::vector<double> stamps{1, 1 + h, 1 + 2 * h, 1 + 3 * h};
    const auto states = integrate<Magnus4>(nav_state(motion.evaluate<1>(1), 1.0), point_samples(motion, stamps));
    std::array<double, 3> velocity_errors;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto initial = nav_state(motion.evaluate<1>(stamps[i]), stamps[i]);
      const auto truth = nav_state(motion.evaluate<1>(stamps[i + 1]), stamps[i + 1]);
      // What the step makes of the truth at its beginning.
      const Eigen::Vector3d change =
          initial.R_WB *
          (states[i].R_WB.inverse() * (states[i + 1].v_WB - states[i].v_WB - h * standard_gravity<double>()));
      velocity_errors[i] = (initial.v_WB + change + h * standard_gravity<double>() - truth.v_WB).norm();
    }
    return velocity_errors;
  };
  const auto coarse = errors(4e-3), fine = errors(2e-3);
  for (std::size_t i = 0; i < 3; ++i) CHECK_THAT(std::log2(coarse[i] / fine[i]), WithinAbs(5, 0.2));
}

TEST_CASE("Magnus4's weights for any intervals are those for regular ones where they are regular") {
  const double h = 0.375;
  for (std::size_t from = 0; from < 3; ++from) {
    const auto general = Magnus4::general_weights<double>({0, h, 2 * h, 3 * h}, from, h);
    const auto regular = Magnus4::regular_weights<double>(from, h);
    for (std::size_t j = 0; j < 4; ++j) {
      CHECK_THAT(general.mean[j], WithinAbs(regular.mean[j], 1e-16));
      CHECK_THAT(general.moment[j], WithinAbs(regular.moment[j], 1e-16));
    }
  }
}

TEST_CASE("Magnus4's weights integrate cubics and their moments exactly, whatever the intervals") {
  const std::array<double, 4> times{0, 0.3, 1.1, 1.4};
  for (std::size_t from = 0; from < 3; ++from) {
    const double a = times[from], b = times[from + 1], h = b - a, middle = (a + b) / 2;
    const auto w = Magnus4::general_weights<double>(times, from, h);
    for (int n = 0; n <= 3; ++n) {
      const auto power = [](double t, int k) { return std::pow(t, k); };
      double mean = 0, moment = 0;
      for (std::size_t j = 0; j < 4; ++j) {
        mean += w.mean[j] * power(times[j], n);
        moment += w.moment[j] * power(times[j], n);
      }
      const double integral = (power(b, n + 1) - power(a, n + 1)) / (n + 1);
      const double first = (power(b, n + 2) - power(a, n + 2)) / (n + 2);
      CHECK_THAT(mean, WithinAbs(integral, 4e-16));
      CHECK_THAT(moment, WithinAbs((first - middle * integral) / h, 4e-16));
    }
  }
}

TEST_CASE("Magnus4 takes intervals as regular only where the weights agree to a millionth") {
  using Sample = ImuSample<>;
  for (const double jitter : {0.0, 0.9e-6, 1.1e-6, 1e-3}) {
    const double h = 0.25;
    const std::array<Sample, 4> window{Sample{0, {}, {}}, Sample{h, {}, {}}, Sample{2 * h, {}, {}},
                                       Sample{(3 + jitter) * h, {}, {}}};
    const auto chosen = Magnus4::weights<double>(window, 1, h);
    const auto exact = Magnus4::general_weights<double>({0, h, 2 * h, (3 + jitter) * h}, 1, h);
    for (std::size_t j = 0; j < 4; ++j) {
      CHECK_THAT(chosen.mean[j], WithinRel(exact.mean[j], 2e-6));
      CHECK_THAT(chosen.moment[j], WithinAbs(exact.moment[j], 1e-6 * h));
    }
  }
}

TEMPLATE_TEST_CASE("Magnus4 is off by at most twice as much as Midpoint, whatever the stamps", "", float, double) {
  testing::check_never_amplifies<Magnus4, Midpoint, TestType>();
}

TEST_CASE("Magnus4's weights are within an interval of the trapezoid's, whatever the intervals") {
  for (const double before : {0.0, 1e-9, 0.1, 0.3, 1.0, 1e9}) {
    for (const double after : {0.0, 1e-9, 0.1, 0.3, 1.0, 1e9}) {
      for (std::size_t from = 0; from < 3; ++from) {
        const std::array<double, 4> times{-before, 0, from == 1 ? 1 : after, (from == 1 ? 1 : after) + after};
        const double h = times[from + 1] - times[from];
        if (!(h > 0)) continue;
        const auto w = Magnus4::general_weights<double>(times, from, h);
        double difference = 0;
        for (std::size_t j = 0; j < 4; ++j) {
          difference += std::abs(w.mean[j] - (j == from || j == from + 1 ? h / 2 : 0));
        }
        CAPTURE(before, after, from);
        CHECK(difference <= h * (1 + 1e-12));
      }
    }
  }
}

TEST_CASE("Two samples are integrated by Magnus4 with a line between them, three with a parabola") {
  using Sample = ImuSample<>;
  const NavState<double> initial{{}, {0, 0, 0}, {0, 0, 0}, 0};
  const auto at = [](double t) { return Sample{t, {0, 0, 0}, {1 + t * (2 + 3 * t), 0, 0}}; };
  const auto velocity = [&](const std::vector<Sample>& samples) {
    return integrate<Magnus4>(initial, samples, Eigen::Vector3d::Zero()).back().v_WB.x();
  };
  CHECK_THAT(velocity({at(0), at(0.5)}), WithinAbs((at(0).accel.x() + at(0.5).accel.x()) / 4, 1e-15));
  CHECK_THAT(velocity({at(0), at(0.5), at(1.25)}), WithinAbs(1.25 + 1.25 * 1.25 + 1.25 * 1.25 * 1.25, 1e-14));
}

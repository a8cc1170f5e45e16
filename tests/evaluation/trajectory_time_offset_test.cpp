// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <limits>
#include <random>
#include <splinertia/evaluation/trajectory_time_offset.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

template <typename G = SO3xR3<double>>
using Poses = std::vector<Stamped<G>>;

// A head that looks about.
Sophus::SO3d looking(double t) {
  const auto exp = [](double x, double y, double z) { return GroupTraits<Sophus::SO3d>::exp({x, y, z}); };
  return exp(0.3 * std::sin(1.1 * t) + 0.2 * std::sin(2.9 * t + 1), 0, 0) * exp(0, 0.4 * std::sin(0.7 * t + 2), 0) *
         exp(0, 0, 0.9 * std::sin(0.31 * t) + 0.1 * std::sin(5.3 * t));
}

struct Recording {
  double rate = 100, start = 0, length = 40;  // Hz, s, s
  double noise = 0;                           // rad, standard deviation of each axis of an attitude
  double offset = 0;                          // s, that the stamps are too early by
  Sophus::SO3d world{}, body{};               // other axes
  unsigned seed = 1;
};

template <typename G = SO3xR3<double>>
Poses<G> recorded(const Recording& r, const auto& attitude) {
  std::mt19937 generator(r.seed);
  std::normal_distribution<double> normal;
  Poses<G> poses;
  for (int i = 0; i < r.rate * r.length; ++i) {
    const double t = r.start + i / r.rate;
    const double x = normal(generator), y = normal(generator), z = normal(generator);
    const Sophus::SO3d R =
        r.world * attitude(t) * r.body * GroupTraits<Sophus::SO3d>::exp(r.noise * Eigen::Vector3d(x, y, z));
    poses.push_back({nanoseconds(1403715524907143168) + to_nanoseconds(t - r.offset), make_pose<G>(R, {t, 0, 0})});
  }
  return poses;
}

std::string refusal(const auto& reference, const auto& estimate, const TimeOffsetOptions& options = {}) {
  return test::error_of<std::invalid_argument>([&] { (void)estimate_time_offset(reference, estimate, options); });
}

const std::string hidden = "estimate_time_offset: the motion does not show the offset: ";

}  // namespace

TEMPLATE_TEST_CASE("A known offset is found, whatever the axes and the rates", "", SO3xR3<double>, Sophus::SE3d) {
  const auto reference = recorded<TestType>({.rate = 200}, looking);
  for (const double offset : {0.0, 0.013, -0.25, 0.9}) {
    for (const double rate : {200.0, 30.0}) {
      const auto estimate = recorded<TestType>({.rate = rate,
                                                .start = 0.0123,
                                                .offset = offset,
                                                .world = GroupTraits<Sophus::SO3d>::exp({1, 2, 3}),
                                                .body = GroupTraits<Sophus::SO3d>::exp({-1, 0.2, 0.3})},
                                               looking);
      const auto found = estimate_time_offset(reference, estimate);
      CHECK_THAT(found.offset, WithinAbs(offset, 1e-4));
      CHECK(found.standard_deviation < 3e-4);
      CHECK(found.correlation > 0.99);
    }
  }
}

TEST_CASE("The standard deviation is that of the errors") {
  double squares = 0;
  int far_off = 0;
  constexpr int runs = 40;
  for (unsigned run = 0; run < runs; ++run) {
    const double offset = 0.013 * (run % 2 == 0 ? 1 : -20);
    const auto reference = recorded({.rate = 100, .noise = 3e-3, .seed = 2 * run + 1}, looking);
    const auto estimate = recorded({.rate = 30, .noise = 3e-3, .offset = offset, .seed = 2 * run + 2}, looking);
    const auto found = estimate_time_offset(reference, estimate);
    CHECK(found.standard_deviation < 2e-3);
    const double deviations = (found.offset - offset) / found.standard_deviation;
    squares += deviations * deviations;
    if (std::abs(deviations) > 4) ++far_off;
  }
  CHECK(squares / runs > 0.4);
  CHECK(squares / runs < 2);
  CHECK(far_off == 0);
}

TEST_CASE("A motion that does not show the offset is refused") {
  const auto still = [](double) { return Sophus::SO3d(); };
  const auto steady = [](double t) { return GroupTraits<Sophus::SO3d>::exp({0, 0, 0.5 * t}); };
  for (const double noise : {0.0, 1e-3}) {
    const Recording first{.noise = noise, .seed = 1}, second{.noise = noise, .seed = 2};
    CHECK(refusal(recorded(first, still), recorded(second, still)).starts_with(hidden));
    CHECK(refusal(recorded(first, steady), recorded(second, steady)).starts_with(hidden));
    CHECK(refusal(recorded(first, looking), recorded(second, still)).starts_with(hidden));
  }
  // Two bodies.
  const auto other = [](double t) { return looking(1.37 * t + 200); };
  CHECK(refusal(recorded({}, looking), recorded({}, other)).starts_with(hidden));
  // It nods twice a second.
  const auto nodding = [](double t) { return GroupTraits<Sophus::SO3d>::exp({0, 0.2 * std::sin(6.2831853 * t), 0}); };
  CHECK(refusal(recorded({.noise = 1e-3, .seed = 1}, nodding),
                recorded({.noise = 1e-3, .offset = 0.05, .seed = 2}, nodding))
            .starts_with(hidden + "the motion repeats itself: "));
  const auto within =
      estimate_time_offset(recorded({.noise = 1e-3, .seed = 1}, nodding),
                           recorded({.noise = 1e-3, .offset = 0.05, .seed = 2}, nodding), {.range = 0.15});
  CHECK_THAT(within.offset, WithinAbs(0.05, 1e-3));
  // Noise hides it.
  CHECK(refusal(recorded({.length = 20, .noise = 0.3, .seed = 1}, looking),
                recorded({.length = 20, .noise = 0.3, .seed = 2}, looking))
            .starts_with(hidden));
}

TEST_CASE("Pure noise is hardly ever taken for motion") {
  const auto still = [](double) { return Sophus::SO3d(); };
  int accepted = 0;
  for (unsigned run = 0; run < 50; ++run) {
    const auto a = recorded({.length = 20, .noise = 1e-3, .seed = 2 * run + 1}, still);
    const auto b = recorded({.length = 20, .noise = 1e-3, .seed = 2 * run + 2}, still);
    if (refusal(a, b).empty()) ++accepted;
  }
  CHECK(accepted == 0);
}

TEST_CASE("A hole in one of them is left out") {
  auto reference = recorded({.noise = 1e-4}, looking);
  const auto estimate = recorded({.noise = 1e-4, .offset = 0.1, .seed = 2}, looking);
  reference.erase(reference.begin() + 1000, reference.begin() + 2500);
  CHECK_THAT(estimate_time_offset(reference, estimate).offset, WithinAbs(0.1, 1e-3));
}

TEST_CASE("What the range, the window and the overlap must be") {
  const auto poses = recorded({}, looking);
  const auto late = recorded({.offset = 0.6}, looking);
  CHECK(refusal(poses, late, {.range = 0.5}).find("end of the range") != std::string::npos);
  CHECK(refusal(poses, recorded({.length = 1}, looking)).find(" s, expected at least 2 s") != std::string::npos);
  CHECK(refusal(poses, recorded({.start = 100}, looking)).find(" s, expected at least 2 s") != std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(refusal(poses, poses, {.range = 0}).find("range 0 s, expected > 0 s and at most 10000 s") != std::string::npos);
  CHECK(refusal(poses, poses, {.range = nan}) != "");
  CHECK(refusal(poses, poses, {.range = 1e9}) != "");
  CHECK(refusal(poses, poses, {.window = -1}) == "estimate_time_offset: window -1 s, expected > 0 s");
  CHECK(refusal(poses, poses, {.window = nan}) != "");
  CHECK(estimate_time_offset(poses, poses, {.window = 0.5}).window == 0.5);
  CHECK(refusal(poses, Poses<>{}) == "associate: the estimate has no poses");
  CHECK(refusal(Poses<>{poses[0]}, poses) != "");
}

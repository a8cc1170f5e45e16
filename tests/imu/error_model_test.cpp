// SPDX-License-Identifier: MIT
#include <splinertia/imu/error_model.hpp>
#include <splinertia/imu/random_walk.hpp>
#include <splinertia/imu/white_noise.hpp>
#include <type_traits>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;

namespace {

// A term of a user's own, without state and without random numbers.
struct Doubling {
  struct State {};
  void apply(Sample<double>& sample, State&) const { sample.value *= 2; }
};

struct PlusOne {
  struct State {};
  void apply(Sample<double>& sample, State&) const { sample.value.array() += 1; }
};

std::vector<Eigen::Vector3d> run(const auto& model, std::uint64_t seed, int n = 50) {
  auto state = model.start(StreamKey(seed) / "gyro");
  std::vector<Eigen::Vector3d> values;
  for (int i = 0; i < n; ++i) {
    Sample<double> sample{Eigen::Vector3d(1, 2, 3), Eigen::Vector3d::Zero(), 0.005, i == 0};
    model.apply(sample, state);
    values.push_back(sample.value);
  }
  return values;
}

}  // namespace

TEST_CASE("The empty model is an empty type and changes nothing") {
  ErrorModel ideal{};
  STATIC_CHECK(std::is_same_v<decltype(ideal), ErrorModel<>>);
  STATIC_CHECK(std::is_empty_v<ErrorModel<>>);
  STATIC_CHECK(std::is_empty_v<ErrorModel<>::State>);
  for (const auto& value : run(ideal, 1)) CHECK(value == Eigen::Vector3d(1, 2, 3));
}

TEST_CASE("Terms apply in the order written") {
  CHECK(run(ErrorModel{Doubling{}, PlusOne{}}, 1)[0] == Eigen::Vector3d(3, 5, 7));
  CHECK(run(ErrorModel{PlusOne{}, Doubling{}}, 1)[0] == Eigen::Vector3d(4, 6, 8));
}

TEST_CASE("The same seed gives the same samples, another seed others") {
  const ErrorModel model{WhiteNoise{0.1}, RandomWalk{0.2}};
  CHECK(run(model, 3) == run(model, 3));
  CHECK(run(model, 3) != run(model, 4));
}

TEST_CASE("Adding a term leaves the samples of the others as they were") {
  const auto noise = run(ErrorModel{WhiteNoise{0.1}}, 5);
  const auto walk = run(ErrorModel{RandomWalk{0.2}}, 5);
  const auto both = run(ErrorModel{RandomWalk{0.2}, WhiteNoise{0.1}}, 5);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    CHECK((both[i] - (noise[i] + walk[i] - Eigen::Vector3d(1, 2, 3))).norm() < 1e-14);
  }
}

TEST_CASE("Two terms of the same kind are independent") {
  const auto one = run(ErrorModel{WhiteNoise{0.1}}, 6);
  const auto two = run(ErrorModel{WhiteNoise{0.1}, WhiteNoise{0.1}}, 6);
  for (std::size_t i = 0; i < one.size(); ++i) {
    const Eigen::Vector3d first = one[i] - Eigen::Vector3d(1, 2, 3);
    const Eigen::Vector3d second = two[i] - one[i];
    CHECK((first - second).norm() > 1e-6);
  }
}

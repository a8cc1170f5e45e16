// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <random>
#include <splinertia/errors/bias/constant_bias.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/noise/random_walk.hpp>
#include <splinertia/errors/noise/white_noise.hpp>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "errors/one_term.hpp"
#include "support/catch.hpp"

using namespace splinertia;

// Terms of a user's own, in a namespace of theirs, written as error_term.hpp says.
namespace user {

/// Without state and without random numbers.
struct Doubling {
  struct State {};
  void apply(SensorSample<double>& sample, State&) const { sample.value *= 2; }
};

struct PlusOne {
  struct State {};
  void apply(SensorSample<double>& sample, State&) const { sample.value.array() += 1; }
};

/// With state: the reading of the sample before.
struct OneSampleLate {
  struct State {
    Eigen::Vector3d held = Eigen::Vector3d::Zero();
  };
  void apply(SensorSample<double>& sample, State& state) const { std::swap(sample.value, state.held); }
};

/// With random numbers: now and then an axis reads nothing.
struct Blackout {
  static constexpr std::string_view name = "blackout";
  template <typename Normals>
  using State = Normals;

  double probability;

  void apply(SensorSample<double>& sample, auto& random) const {
    if (random.uniform() < probability) sample.value.x() = 0;
  }
};

/// Not two of these, and none behind a OneSampleLate or before it.
struct Jealous {
  struct State {};
  void apply(SensorSample<double>&, State&) const {}
};
inline void check_together(const Jealous&, const Jealous&) { throw std::invalid_argument("one Jealous is enough"); }
inline void check_together(const OneSampleLate&, const Jealous&) { throw std::invalid_argument("too late"); }

}  // namespace user

namespace {

using user::Blackout, user::Doubling, user::Jealous, user::OneSampleLate, user::PlusOne;

template <BitGenerator Generator = Xoshiro256>
std::vector<Eigen::Vector3d> run(const auto& model, std::uint64_t seed, int n = 50) {
  auto state = model.template start<3, Generator>(StreamKey(seed) / "gyro");
  std::vector<Eigen::Vector3d> values;
  for (int i = 0; i < n; ++i) {
    auto sample = testing::sample_with<double>({1, 2, 3}, {0, 0, 0}, 0.01 * i);
    model.apply(sample, state);
    values.push_back(sample.value);
  }
  return values;
}

}  // namespace

TEST_CASE("The empty model is an empty type and changes nothing") {
  constexpr ErrorModel ideal{};
  STATIC_CHECK(std::is_same_v<decltype(ideal), const ErrorModel<>>);
  STATIC_CHECK(std::is_empty_v<ErrorModel<>>);
  STATIC_CHECK(std::is_empty_v<ErrorModel<>::State<>>);
  for (const auto& value : run(ideal, 1)) CHECK(value == Eigen::Vector3d(1, 2, 3));
}

TEST_CASE("A model takes the room of its terms' parameters") {
  STATIC_CHECK(sizeof(ErrorModel<Doubling, PlusOne>) == 1);  // libc++'s std::tuple is never empty
  STATIC_CHECK(sizeof(ErrorModel<WhiteNoise<float>, RandomWalk<float>>) ==
               6 * sizeof(float));  // one value has room for three
  STATIC_CHECK(sizeof(ErrorModel<WhiteNoise<float>, Doubling>) == 3 * sizeof(float));
}

TEST_CASE("Terms apply in the order written") {
  CHECK(run(ErrorModel{Doubling{}, PlusOne{}}, 1)[0] == Eigen::Vector3d(3, 5, 7));
  CHECK(run(ErrorModel{PlusOne{}, Doubling{}}, 1)[0] == Eigen::Vector3d(4, 6, 8));
}

TEST_CASE("The same seed gives the same samples, another seed others") {
  const ErrorModel model{WhiteNoise{0.1}, RandomWalk{0.2}};
  CHECK(run(model, 3) == run(model, 3));
  CHECK(run(model, 3) != run(model, 4));
  CHECK(run<std::mt19937_64>(model, 3) == run<std::mt19937_64>(model, 3));
  CHECK(run<std::mt19937_64>(model, 3) != run(model, 3));
}

TEST_CASE("Adding a term leaves the samples of the others as they were") {
  const auto noise = run(ErrorModel{WhiteNoise{0.1}}, 5);
  const auto walk = run(ErrorModel{RandomWalk{0.2}}, 5);
  const auto both = run(ErrorModel{RandomWalk{0.2}, WhiteNoise{0.1}}, 5);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    CHECK((both[i] - (noise[i] + walk[i] - Eigen::Vector3d(1, 2, 3))).norm() < 1e-14);
  }
}

TEST_CASE("Two terms of the same name are independent, and the first is as it was alone") {
  const auto one = run(ErrorModel{WhiteNoise{0.1}}, 6);
  const auto two = run(ErrorModel{WhiteNoise{0.1}, ConstantBias{0}, WhiteNoise{0.1}}, 6);
  for (std::size_t i = 0; i < one.size(); ++i) {
    const Eigen::Vector3d first = one[i] - Eigen::Vector3d(1, 2, 3);
    const Eigen::Vector3d second = two[i] - one[i];
    CHECK((first - second).cwiseAbs().minCoeff() > 1e-6);
  }
  // The second's numbers have their own name.
  const WhiteNoise noise{0.1};
  NormalStreams alone(StreamKey(6) / "gyro" / "white noise" / 1);
  auto sample = testing::sample_with<double>({0, 0, 0});
  noise.apply(sample, alone);
  CHECK((two[0] - one[0] - sample.value).norm() < 1e-15);
}

TEST_CASE("A model can be made longer, and stays as it is itself") {
  constexpr ErrorModel model{ConstantBias{1}};
  constexpr auto longer = model.with(WhiteNoise{0.1}, ConstantBias{2});
  STATIC_CHECK(std::is_same_v<decltype(longer),
                              const ErrorModel<ConstantBias<double>, WhiteNoise<double>, ConstantBias<double>>>);
  STATIC_CHECK(std::get<2>(longer.terms()).bias[0] == 2);
  CHECK(run(longer, 1) == run(ErrorModel{ConstantBias{1}, WhiteNoise{0.1}, ConstantBias{2}}, 1));
  CHECK(run(model, 1)[0] == Eigen::Vector3d(2, 3, 4));
  STATIC_CHECK(std::is_same_v<decltype(ErrorModel{}.with(Doubling{})), ErrorModel<Doubling>>);
}

TEST_CASE("A copy of a model is a model of the same terms") {
  ErrorModel model{ConstantBias{1}, WhiteNoise{0.1}};
  ErrorModel copy{model};
  STATIC_CHECK(std::is_same_v<decltype(copy), decltype(model)>);
  model = ErrorModel{ConstantBias{2}, WhiteNoise{0.1}};
  CHECK(run(model, 1)[0] == run(copy, 1)[0] + Eigen::Vector3d::Constant(1));
}

TEST_CASE("Terms of a user's own: with a state, and with random numbers") {
  STATIC_CHECK(ErrorTerm<Doubling>);
  STATIC_CHECK_FALSE(StochasticTerm<Doubling>);
  STATIC_CHECK(StochasticTerm<Blackout>);
  STATIC_CHECK_FALSE(ErrorTerm<double>);
  STATIC_CHECK_FALSE(ErrorTerm<ErrorModel<Doubling>>);

  const auto late = run(ErrorModel{OneSampleLate{}, PlusOne{}}, 1, 3);
  CHECK(late[0] == Eigen::Vector3d(1, 1, 1));
  CHECK(late[1] == Eigen::Vector3d(2, 3, 4));

  int zeros = 0;
  const auto noise = run(ErrorModel{WhiteNoise{0.1}}, 7, 1000);
  const auto both = run(ErrorModel{WhiteNoise{0.1}, Blackout{0.25}}, 7, 1000);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    zeros += both[i].x() == 0;
    CHECK((both[i].x() == 0 || both[i] == noise[i]));
  }
  CHECK(zeros > 195);  // four standard deviations of 13.7
  CHECK(zeros < 305);
}

TEST_CASE("Terms that cannot stand together are found by their own functions, in either order") {
  CHECK_NOTHROW(ErrorModel{Jealous{}});
  CHECK_NOTHROW(ErrorModel{Jealous{}, PlusOne{}, Doubling{}});
  CHECK_NOTHROW(ErrorModel{OneSampleLate{}, OneSampleLate{}});
  CHECK_THROWS_WITH((ErrorModel{Jealous{}, PlusOne{}, Jealous{}}), "one Jealous is enough");
  CHECK_THROWS_WITH((ErrorModel{OneSampleLate{}, Jealous{}}), "too late");
  CHECK_THROWS_WITH((ErrorModel{Jealous{}, PlusOne{}, OneSampleLate{}}), "too late");
  CHECK_THROWS_WITH(ErrorModel{Jealous{}}.with(OneSampleLate{}), "too late");
}

TEST_CASE("One model serves several runs at once") {
  const ErrorModel model{RandomWalk{0.2}, OneSampleLate{}, WhiteNoise{0.1}};
  const auto expected_a = run(model, 8), expected_b = run(model, 9);
  auto a = model.start(StreamKey(8) / "gyro");
  auto b = model.start(StreamKey(9) / "gyro");
  for (std::size_t i = 0; i < expected_a.size(); ++i) {
    auto sample_a = testing::sample_with<double>({1, 2, 3}, {0, 0, 0}, 0.01 * static_cast<double>(i));
    auto sample_b = sample_a;
    model.apply(sample_a, a);
    model.apply(sample_b, b);
    CHECK(sample_a.value == expected_a[i]);
    CHECK(sample_b.value == expected_b[i]);
  }
}

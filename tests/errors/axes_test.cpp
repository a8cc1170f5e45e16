// SPDX-License-Identifier: MIT
// Every term with sensors of 1, 2, 3 and 6 axes: an axis reads what it would read alone, beside any others.
#include <random>
#include <splinertia/splinertia.hpp>
#include <type_traits>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

template <typename Scalar, int Axes>
using Values = std::vector<AxisVector<Scalar, Axes>>;

// Each term for sensors of any number of axes, with one value for all.
template <typename Scalar>
auto terms() {
  const auto s = [](double x) { return static_cast<Scalar>(x); };
  return std::tuple(
      ConstantBias{s(0.1)}, RateRamp{s(0.1)}, TurnOnBias{s(0.1)}, TemperatureBias{s(1e-2), WarmUp{s(20), s(45), s(2)}},
      TemperatureScale{s(1e-3), WarmUp{s(20), s(45), s(2)}}, ScaleFactor{s(0.01)}, ScaleFactorAsymmetry{s(0.1)},
      VibrationRectification{s(0.1)}, WhiteNoise{s(0.01)}, RandomWalk{s(0.01)}, GaussMarkov{s(0.1), s(3)},
      GaussMarkov{s(0.1), s(3), s(1)}, BiasInstability{s(0.01)}, QuantizationNoise{s(0.01)},
      RandomVibration{s(0.1), s(30), s(0.1)}, SinusoidalVibration{s(0.1), s(17), s(0.1)}, FirstOrderBandwidth{s(10)},
      SecondOrderBandwidth{s(10), s(0.7)}, Quantization{s(0.05)}, Saturation{s(3)}, Spikes{s(0.2), s(1)},
      StuckReadings{s(0.3), s(3)});
}

// What a model makes of axis i measuring i + 1 and moving, with the bias as the second half.
template <int Axes, typename Scalar>
Values<Scalar, 2 * Axes> run(const auto& model, int count = 30) {
  auto state = model.template start<Axes>(StreamKey(5) / "sensor");
  Values<Scalar, 2 * Axes> all;
  for (int i = 0; i < count; ++i) {
    SensorSample<Scalar, Axes> sample{{}, {}, Scalar(0.01), i == 0, Scalar(0.01) * static_cast<Scalar>(i)};
    for (int axis = 0; axis < Axes; ++axis) {
      sample.value[axis] = static_cast<Scalar>((axis + 1) * (i % 7 - 3));
      sample.bias[axis] = static_cast<Scalar>(axis);
    }
    model.apply(sample, state);
    AxisVector<Scalar, 2 * Axes> both;
    both << sample.value, sample.bias;
    all.push_back(both);
  }
  return all;
}

template <int Axes, typename Scalar>
void check_beside_three(const auto& model) {
  const auto three = run<3, Scalar>(model);
  const auto others = run<Axes, Scalar>(model);
  for (std::size_t i = 0; i < three.size(); ++i) {
    for (int axis = 0; axis < (std::min)(3, Axes); ++axis) {
      REQUIRE(others[i][axis] == three[i][axis]);
      REQUIRE(others[i][Axes + axis] == three[i][3 + axis]);
    }
  }
}

}  // namespace

TEMPLATE_TEST_CASE("Axis i reads the same in a sensor of any number of axes", "", float, double) {
  std::apply(
      [](const auto&... term) {
        const auto check = [](const auto& each) {
          INFO(std::remove_cvref_t<decltype(each)>::name);
          const ErrorModel model{each};
          check_beside_three<1, TestType>(model);
          check_beside_three<2, TestType>(model);
          check_beside_three<6, TestType>(model);
        };
        (check(term), ...);
        const ErrorModel all{term...};
        check_beside_three<1, TestType>(all);
        check_beside_three<6, TestType>(all);
      },
      terms<TestType>());
}

TEMPLATE_TEST_CASE("States hold what the axes need", "", float, double) {
  using S = TestType;
  STATIC_CHECK(sizeof(StateOf<WhiteNoise<S>, 1>) == sizeof(NormalStream<>));
  STATIC_CHECK(sizeof(StateOf<WhiteNoise<S>, 2>) == 2 * sizeof(NormalStream<>));
  STATIC_CHECK(sizeof(StateOf<WhiteNoise<S>, 6>) == 6 * sizeof(NormalStream<>));
  STATIC_CHECK(sizeof(StateOf<DroppedSamples<S>, 1>) == sizeof(NormalStream<>));
  CHECK(StateOf<RandomWalk<S>, 2>(StreamKey(1)).bias.size() == 2);
  STATIC_CHECK(std::is_empty_v<StateOf<ConstantBias<S>, 6>>);
  STATIC_CHECK(sizeof(StateOf<FirstOrderBandwidth<S>, 1>) < sizeof(StateOf<FirstOrderBandwidth<S>, 3>));
  CHECK(StateOf<TurnOnBias<S>, 6>(StreamKey(1)).normal.size() == 6);
}

TEST_CASE("Streams of six axes are those of three, and three more, all different") {
  NormalStreams<Xoshiro256, 6> six(StreamKey(1));
  NormalStreams three(StreamKey(1));
  NormalStream last(StreamKey(1) / 5);
  for (int i = 0; i < 20; ++i) {
    const auto n = six.draw<double>();
    CHECK(n.head<3>() == three.draw<double>());
    CHECK(n[5] == last());
    const auto u = six.draw_uniform(), v = six.draw_uniform();
    CHECK(u.head<3>() == three.draw_uniform());
    CHECK(u[5] == last.uniform());
    CHECK((u.minCoeff() >= 0 && u.maxCoeff() < 1));
    CHECK((u - v).cwiseAbs().minCoeff() > 0);
    CHECK(v.head<3>() == three.draw_uniform());
    static_cast<void>(last.uniform());
  }
}

TEST_CASE("One value is the same as that value for each axis") {
  const ErrorModel one{RandomWalk{0.1}, WhiteNoise{0.2}, GaussMarkov{0.1, 3}, FirstOrderBandwidth{7}, Saturation{2}};
  const PerAxis<double> w = 0.1, n = 0.2, m(0.1, 0.1, 0.1), f(7, 7, 7), limit = 2;
  const ErrorModel each{RandomWalk{w}, WhiteNoise{n}, GaussMarkov{m, 3}, FirstOrderBandwidth{f}, Saturation{limit}};
  CHECK(run<3, double>(one) == run<3, double>(each));
}

TEST_CASE("A value for each axis goes to that axis") {
  const ErrorModel pixel{ConstantBias{PerAxis(1, 2)}, ScaleFactor{Eigen::Vector2d(0.5, 1)}, Saturation{PerAxis(5, 7)}};
  auto state = pixel.start<2>(StreamKey(1));
  SensorSample<double, 2> sample{{1, 2}, {0, 0}, 0.1, true, 0};
  pixel.apply(sample, state);
  CHECK(sample.value == Eigen::Vector2d(3, 7));
  CHECK(sample.bias == Eigen::Vector2d(1.5, 4));
  STATIC_CHECK(std::is_same_v<decltype(WhiteNoise{PerAxis(1, 2)}), WhiteNoise<double, 2>>);
  STATIC_CHECK(std::is_same_v<decltype(GaussMarkov{1, PerAxis(1, 2)}), GaussMarkov<double, 2>>);
  STATIC_CHECK(std::is_same_v<decltype(Misalignment{Eigen::Matrix2f()}), Misalignment<float, 2>>);
  STATIC_CHECK(sizeof(WhiteNoise<double, 6>) == 6 * sizeof(double));
}

TEST_CASE("A matrix of any size mixes the axes, and is refused if it is singular") {
  const ErrorModel model{Misalignment{Eigen::Matrix2d{{1, 2}, {3, 4}}}};
  auto state = model.start<2>(StreamKey(1));
  SensorSample<double, 2> sample{{1, 10}, {1, 1}, 0.1, true, 0};
  model.apply(sample, state);
  CHECK(sample.value == Eigen::Vector2d(21, 43));
  CHECK(sample.bias == Eigen::Vector2d(3, 7));
  CHECK_THROWS_AS((Misalignment{Eigen::Matrix2d{{1, 2}, {2, 4}}}), std::invalid_argument);
  CHECK_THROWS_AS((Misalignment{Eigen::Matrix<double, 6, 6>(Eigen::Matrix<double, 6, 6>::Ones())}),
                  std::invalid_argument);
  CHECK_NOTHROW(Misalignment{Eigen::Matrix<double, 6, 6>(1e-200 * Eigen::Matrix<double, 6, 6>::Identity())});
}

// SPDX-License-Identifier: MIT
#include <splinertia/errors/describe.hpp>
#include <splinertia/errors/noise/correlated_noise.hpp>
#include <splinertia/errors/noise/white_noise.hpp>

#include "errors/statistics.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::testing;

namespace {
const Eigen::Matrix3d R{{1, 0.5, -0.25}, {0.5, 1, 0}, {-0.25, 0, 1}};
}

TEMPLATE_TEST_CASE("The covariance of the axes is N_i N_j R_ij/dt, white from sample to sample", "", float, double) {
  using Scalar = TestType;
  const double N[] = {0.1, 0.2, 3};
  const ErrorModel model{CorrelatedNoise{per_axis<Scalar>(N), Eigen::Matrix3<Scalar>(R.cast<Scalar>())}};
  const Record errors = record<Scalar>(model, regular(200), 5);
  CHECK(errors.no_bias);
  const auto n = static_cast<double>(million);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double unit = N[i] * N[j] * 200, r = R(static_cast<int>(i), static_cast<int>(j));
      Estimate product = mean_product(errors.axes[i], errors.axes[j]);
      // Isserlis: the variance of x_i x_j is (1 + r²) times the product of the variances.
      product = {product.value / unit, r, std::sqrt((1 + r * r) / n)};
      CHECK(off(product) < 4);
      std::vector<double> later(errors.axes[j].begin() + 1, errors.axes[j].end());
      later.push_back(0);
      CHECK(off({mean_product(errors.axes[i], later).value / unit, 0, 1 / std::sqrt(n)}) < 4);
    }
  }
}

TEST_CASE("With a correlation of one the axes read the same, with none the noise is white noise of other streams") {
  const ErrorModel same{CorrelatedNoise{0.1, Eigen::Matrix2d(Eigen::Matrix2d::Ones())}};
  auto state = same.start<2>(StreamKey(1));
  for (int i = 0; i < 10; ++i) {
    SensorSample<double, 2> sample{{0, 0}, {0, 0}, 0.01, i == 0, 0};
    same.apply(sample, state);
    CHECK(sample.value[0] == sample.value[1]);
    CHECK(sample.value[0] != 0);
  }
  const CorrelatedNoise none{0.1, Eigen::Matrix3d(Eigen::Matrix3d::Identity())};
  NormalStreams a(StreamKey(1)), b(StreamKey(1));
  SensorSample<double> one{{0, 0, 0}, {0, 0, 0}, 0.01, true, 0}, other = one;
  none.apply(one, a);
  WhiteNoise{0.1}.apply(other, b);
  CHECK((one.value - other.value).norm() < 1e-15);
}

TEST_CASE("What is no matrix of correlations is refused") {
  const auto with = [](double diagonal, double upper, double lower) {
    return CorrelatedNoise{0.1, Eigen::Matrix2d{{1, upper}, {lower, diagonal}}};
  };
  CHECK_NOTHROW(with(1, -1, -1));
  CHECK_THROWS_WITH(with(2, 0, 0), "CorrelatedNoise: correlation is 2, expected 1 on the diagonal");
  CHECK_THROWS_WITH(with(1, 0.5, 0.25), "CorrelatedNoise: correlation is 0.25, expected a symmetric matrix");
  CHECK_THROWS_WITH(with(1, 1.5, 1.5), "CorrelatedNoise: correlation is 1.5, expected a number >= -1 and <= 1");
  CHECK_THROWS_AS(with(1, std::nan(""), 0), std::invalid_argument);
  CHECK_THROWS_AS((CorrelatedNoise{-0.1, R}), std::invalid_argument);
  CHECK_THROWS_AS((CorrelatedNoise{1, Eigen::Matrix3d{{1, 1, 0}, {1, 1, 0.5}, {0, 0.5, 1}}}), std::invalid_argument);
}

TEST_CASE("Correlations computed from a covariance are accepted and made symmetric") {
  const Eigen::Matrix3d A{{1, 0.3, 0.1}, {0.7, 2, 0}, {0.2, -0.4, 0.6}}, S = A * A.transpose();
  const Eigen::Vector3d scale = S.diagonal().cwiseSqrt().cwiseInverse();
  const CorrelatedNoise noise{0.1, Eigen::Matrix3d(scale.asDiagonal() * S * scale.asDiagonal())};
  CHECK(noise.correlation.diagonal() == Eigen::Vector3d::Ones());
  CHECK(noise.correlation == noise.correlation.transpose());
}

TEST_CASE("Correlated noise in words") {
  CHECK(describe(CorrelatedNoise{0.1, Eigen::Matrix2d{{1, 0.5}, {0.5, 1}}}, "px") ==
        "correlated noise: density 0.1 px/sqrt(Hz), correlation (1 0.5; 0.5 1)");
}

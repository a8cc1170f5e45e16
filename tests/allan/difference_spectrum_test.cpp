// SPDX-License-Identifier: MIT
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>
#include <numbers>
#include <splinertia/allan/difference_spectrum.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <splinertia/detail/pi.hpp>
#include <vector>

#include "allan/reference.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;
using namespace splinertia::testing;

namespace {

using namespace splinertia::detail;

/// S_ki = √(2/n) sin(πik/n), i, k = 1 … n − 1, with the angle reduced exactly.
template <typename Scalar>
Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> sines(Eigen::Index n) {
  Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> S(n - 1, n - 1);
  for (Eigen::Index k = 1; k < n; ++k) {
    for (Eigen::Index i = 1; i < n; ++i) {
      const auto turn = static_cast<Scalar>((i * k) % (2 * n)) / static_cast<Scalar>(n);
      S(k - 1, i - 1) = std::sqrt(2 / static_cast<Scalar>(n)) * std::sin(splinertia::detail::pi_of<Scalar>() * turn);
    }
  }
  return S;
}

template <typename Scalar>
using VectorX = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

template <typename Scalar>
VectorX<Scalar> transformed(const std::vector<Scalar>& d) {
  const auto b = sine_transform(d);
  return Eigen::Map<const VectorX<Scalar>>(b.data(), std::ssize(b));
}

/// Columns of the second differences z_{i+1} − 2z_i + z_{i−1}, i = 1 … n − 1, of z_0 … z_n.
Eigen::MatrixXd second_differences(Eigen::Index n) {
  Eigen::MatrixXd D = Eigen::MatrixXd::Zero(n - 1, n + 1);
  for (Eigen::Index i = 0; i + 1 < n; ++i) D.row(i).segment<3>(i) << 1, -2, 1;
  return D;
}

Eigen::MatrixXd tridiagonal(Eigen::Index size) {
  Eigen::MatrixXd T = 2 * Eigen::MatrixXd::Identity(size, size);
  T.diagonal(1).setConstant(-1);
  T.diagonal(-1).setConstant(-1);
  return T;
}

constexpr std::size_t index_of(NoiseTerm term) { return static_cast<std::size_t>(term); }

}  // namespace

TEMPLATE_TEST_CASE("The sine transform is that of its definition, and orthonormal", "", double, long double) {
  using Scalar = TestType;
  // Eigen's factors are rounded to double.
  const Scalar epsilon = static_cast<Scalar>(std::numeric_limits<double>::epsilon());
  std::vector<std::size_t> lengths{97, 120, 121, 128, 210, 251};
  for (std::size_t n = 2; n <= 40; ++n) lengths.push_back(n);
  for (const std::size_t n : lengths) {
    INFO("n = " << n);
    const auto d = scaled(noisy_integers(n - 1, 100, 1000, 30), Scalar(1) / 1000);
    const auto column = Eigen::Map<const VectorX<Scalar>>(d.data(), std::ssize(d));
    const VectorX<Scalar> b = transformed(d);
    const VectorX<Scalar> exact =
        (sines<long double>(static_cast<Eigen::Index>(n)) * column.template cast<long double>())
            .template cast<Scalar>();
    REQUIRE(b.size() == column.size());
    CHECK((b - exact).norm() <= 8 * epsilon * column.norm());
    CHECK(std::abs(b.norm() / column.norm() - 1) <= 8 * epsilon);
    // It is its own inverse.
    CHECK((transformed(std::vector<Scalar>(b.begin(), b.end())) - column).norm() <= 16 * epsilon * column.norm());
  }
}

TEST_CASE("The sine transform of a long signal") {
  for (const std::size_t n : {99'999U, 100'000U, 131'072U}) {
    // sin(πik/n) is the one of index k.
    std::vector<double> d(n - 1);
    const std::size_t k = n / 3;
    for (std::size_t i = 1; i < n; ++i) {
      const auto turn = static_cast<double>((i * k) % (2 * n)) / static_cast<double>(n);
      d[i - 1] = std::sin(std::numbers::pi * turn);
    }
    auto b = sine_transform(d);
    CHECK_THAT(b[k - 1], WithinRel(std::sqrt(static_cast<double>(n) / 2), 1e-14));
    b[k - 1] = 0;
    CHECK(*std::max_element(b.begin(), b.end()) < 1e-12);
    CHECK(*std::min_element(b.begin(), b.end()) > -1e-12);
  }
}

TEST_CASE("The length of a transform") {
  for (std::int64_t n = 0; n <= 1024; ++n) CHECK(transform_length(n) == n);
  double lost = 0;
  std::int64_t last = 1024;
  bool same = true;
  for (std::int64_t n = 1025; n <= 100'000; ++n) {
    std::int64_t rest = n;
    for (std::int64_t factor = 2; factor <= 13; ++factor) {
      while (rest % factor == 0) rest /= factor;
    }
    if (rest == 1) last = n;
    same = same && transform_length(n) == last;
    lost += 1 - static_cast<double>(last) / static_cast<double>(n);
  }
  CHECK(same);
  CHECK(lost / 100'000 < 2e-3);
  CHECK(transform_length(1'000'000'007) >= 999'000'000);
}

TEST_CASE("White noise and random walk are independent on sines") {
  for (const Eigen::Index n : {2, 3, 4, 7, 16, 45, 60}) {
    const double walk = 0.37, white = 2.1;
    const Eigen::MatrixXd S = sines<double>(n);
    const Eigen::MatrixXd covariance =
        S * (walk * Eigen::MatrixXd::Identity(n - 1, n - 1) + white * tridiagonal(n - 1)) * S.transpose();
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(n - 1, n - 1);
    for (Eigen::Index k = 1; k < n; ++k) {
      const double sine = std::sin(std::numbers::pi * static_cast<double>(k) / static_cast<double>(2 * n));
      expected(k - 1, k - 1) = walk + white * 4 * sine * sine;
    }
    CHECK((covariance - expected).cwiseAbs().maxCoeff() < 1e-13);
  }
}

TEST_CASE("Quantization has the square of white noise's power, but for the ends") {
  for (const Eigen::Index n : {3, 8, 60}) {
    const Eigen::MatrixXd D = second_differences(n), T = tridiagonal(n - 1);
    Eigen::MatrixXd difference = D * D.transpose() - T * T;
    CHECK(difference(0, 0) == 1);
    CHECK(difference(n - 2, n - 2) == 1);
    difference(0, 0) = difference(n - 2, n - 2) = 0;
    CHECK(difference.cwiseAbs().maxCoeff() == 0);
  }
}

TEMPLATE_TEST_CASE("What the bins of a spectrum hold", "", double, long double) {
  using Scalar = TestType;
  const Scalar epsilon = std::numeric_limits<Scalar>::epsilon(), tolerance = 200 * epsilon, rate = 200;
  for (const std::size_t samples : {3U, 4U, 60U, 127U, 128U, 129U, 1000U, 1031U, 5003U}) {
    INFO(samples << " samples");
    const auto y = scaled(noisy_integers(samples, 9810, 50, 5), Scalar(1) / 1000);
    const DifferenceSpectrum<Scalar> spectrum{IntegratedSignal<Scalar>(y, rate)};
    const auto n = static_cast<std::size_t>(spectrum.samples());
    CHECK(spectrum.samples() == transform_length(static_cast<std::int64_t>(samples)));
    CHECK(spectrum.rate() == rate);
    CHECK(spectrum.unit() == 16);
    std::vector<Scalar> d;
    for (std::size_t i = 0; i + 1 < n; ++i) d.push_back((y[i + 1] - y[i]) / spectrum.unit());
    const auto b = sine_transform(d);
    std::size_t k = 1;
    Scalar power = 0;
    for (const auto& bin : spectrum.bins()) {
      const std::size_t first = k, count = static_cast<std::size_t>(bin.count);
      CHECK(static_cast<Scalar>(count) == bin.count);
      CHECK((count == 1 || count * 64 <= first));
      Scalar sum = 0, product = 0, square = 0, white = 0, flicker = 0, quantization = 0;
      for (; k < first + count; ++k) {
        const Scalar angle = splinertia::detail::pi_of<Scalar>() * static_cast<Scalar>(k) / static_cast<Scalar>(2 * n);
        const Scalar w = k % 2 == 1 ? std::sqrt(2 / static_cast<Scalar>(n)) / std::tan(angle) : Scalar(0);
        sum += b[k - 1] * b[k - 1];
        product += b[k - 1] * w;
        square += w * w;
        white += 4 * std::sin(angle) * std::sin(angle) / bin.count;
        flicker += 2 * std::sin(angle) / bin.count;
        quantization += 16 * std::pow(std::sin(angle), Scalar(4)) / bin.count;
      }
      // In units of 16 m/s² the samples are rounded to 1e-17.
      CHECK(std::abs(bin.power - sum) <= tolerance * std::sqrt(sum * bin.count));
      CHECK(std::abs(bin.ramp_product - product) <= tolerance * std::sqrt(square * bin.count));
      CHECK(std::abs(bin.ramp_square - square) <= tolerance * square);
      CHECK(std::abs(bin.basis[index_of(NoiseTerm::white)] / white - 1) <= tolerance);
      CHECK(bin.basis[index_of(NoiseTerm::random_walk)] == 1);
      CHECK(std::abs(bin.basis[index_of(NoiseTerm::bias_instability)] / flicker - 1) <= tolerance);
      CHECK(std::abs(bin.basis[index_of(NoiseTerm::quantization)] / quantization - 1) <= tolerance);
      const Scalar middle = static_cast<Scalar>(first + k - 1) / 2;
      CHECK(std::abs(bin.frequency * static_cast<Scalar>(2 * n) / (middle * rate) - 1) <= tolerance);
      power += bin.power;
    }
    CHECK(k == n);
    Scalar squares = 0;
    for (const Scalar difference : d) squares += difference * difference;
    CHECK(std::abs(power / squares - 1) <= Scalar(1e-13L));  // of the running sums, too
  }
}

TEST_CASE("The mean of a ramp") {
  for (const Eigen::Index n : {2, 3, 10, 61}) {
    const Eigen::VectorXd ramp = sines<double>(n) * Eigen::VectorXd::Ones(n - 1);
    for (Eigen::Index k = 1; k < n; ++k) {
      const auto angle = std::numbers::pi * static_cast<double>(k) / static_cast<double>(2 * n);
      const double expected = k % 2 == 1 ? std::sqrt(2 / static_cast<double>(n)) / std::tan(angle) : 0.0;
      CHECK_THAT(ramp[k - 1], WithinAbs(expected, 1e-13 * std::sqrt(static_cast<double>(n))));
    }
  }
  // A signal that is nothing else is explained to the last digit, also in bins of many.
  for (const std::size_t n : {3U, 50U, 3000U}) {
    std::vector<double> y(n);
    for (std::size_t i = 0; i < n; ++i) y[i] = 5 - static_cast<double>(i) / 1024;
    const DifferenceSpectrum<double> spectrum{IntegratedSignal<double>(y, 10)};
    const double slope = -1.0 / 1024 / spectrum.unit();
    for (const auto& bin : spectrum.bins()) {
      CHECK_THAT(bin.ramp_product, WithinAbs(slope * bin.ramp_square, 1e-12 * std::abs(slope * bin.ramp_square)));
      CHECK_THAT(bin.power, WithinAbs(slope * slope * bin.ramp_square, 1e-13 * slope * slope * static_cast<double>(n)));
    }
  }
}

TEST_CASE("A spectrum does not depend on the mean of the signal, and scales with it") {
  const Integers integers = noisy_integers(3000, 0, 500, 10);
  const DifferenceSpectrum<double> spectrum{IntegratedSignal<double>(scaled(integers, 1.0), 50)};
  auto moved = integers;
  for (auto& y : moved) y += 100'000'000;
  const DifferenceSpectrum<double> other{IntegratedSignal<double>(scaled(moved, 1.0), 50)};
  const DifferenceSpectrum<double> tiny{IntegratedSignal<double>(scaled(integers, 0x1p-900), 50)};
  const double ratio = other.unit() / spectrum.unit();
  CHECK(tiny.unit() == spectrum.unit() * 0x1p-900);
  for (std::size_t i = 0; i < spectrum.bins().size(); ++i) {
    const auto& bin = spectrum.bins()[i];
    CHECK_THAT(other.bins()[i].power * ratio * ratio, WithinRel(bin.power, 1e-6));
    CHECK(tiny.bins()[i].power == bin.power);
    CHECK(tiny.bins()[i].ramp_product == bin.ramp_product);
  }
}

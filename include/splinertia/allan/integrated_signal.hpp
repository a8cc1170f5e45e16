// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <limits>
#include <splinertia/allan/detail/compensated_sum.hpp>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/require.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <vector>

namespace splinertia::allan {

/// A forward range of equally spaced samples: a std::vector, a std::span, an Eigen vector, a view of one axis of a log.
template <typename S>
concept Signal = requires(const S& signal) {
  { std::begin(signal) } -> std::forward_iterator;
  requires std::is_arithmetic_v<std::iter_value_t<decltype(std::begin(signal))>>;
  { std::begin(signal) != std::end(signal) } -> std::convertible_to<bool>;
};

namespace detail {

/// The scalar type of the analysis of a signal: long double for long double samples, otherwise double.
template <Signal S>
using ScalarOfSignal =
    std::conditional_t<std::same_as<std::iter_value_t<decltype(std::begin(std::declval<const S&>()))>, long double>,
                       long double, double>;

}  // namespace detail

/// The running sums of a signal y_0 … y_{n−1} about its mean. All deviations are differences of these sums.
/// x_0 = 0, x_{i+1} = x_i + (y_i − mean); an average over m samples is (x_{i+m} − x_i)/m + mean.
///
/// The mean is removed because x, and with it the rounding errors of x, would otherwise grow with the number of
/// samples: 10⁸ samples of a specific force of 9.81 m/s² would lose up to 4 % of the deviation at long averaging times.
/// The sums are compensated: each x_i is the exact sum of the rounded y_j − mean to within eps·|x_i|.
///
/// Memory: n + 1 scalars. Throws std::invalid_argument for a rate that is not finite and > 0, one at which 64·n/rate is
/// infinite, fewer than 3 samples, a sample that is not finite, and a constant signal (a stuck sensor, or no noise).
template <std::floating_point Scalar_ = double>
class IntegratedSignal {
 public:
  using Scalar = Scalar_;

  /// From a rate signal: angular velocity [rad/s] or specific force [m/s²]; rate in Hz.
  template <Signal S>
  IntegratedSignal(const S& signal, Scalar rate) : rate_(rate) {
    const auto n = static_cast<Scalar>(read(signal, 3, 1));
    const Scalar first = sums_[1];
    if (std::all_of(sums_.begin() + 1, sums_.end(), [&](Scalar y) { return y == first; })) refuse_constant(first);
    const Scalar mean = scaled_sum() / n;
    detail::CompensatedSum<Scalar> x;
    for (auto y = sums_.begin() + 1; y != sums_.end(); ++y) {
      x.add(*y * per_unit_ - mean);
      *y = x.value();
    }
    mean_ = (mean + x.value() / n) * unit_;
  }

  /// From the integral of a rate signal, as measured by clocks ("phase", s) and integrating gyroscopes (angle, rad):
  /// n + 1 values for n samples of the rate.
  template <Signal S>
  [[nodiscard]] static IntegratedSignal from_integral(const S& integral, Scalar rate) {
    IntegratedSignal result(rate);
    const std::size_t n = result.read(integral, 4, 0) - 1;
    const Scalar scale = result.per_unit_, first = result.sums_.front() * scale;
    const Scalar step = (result.sums_.back() * scale - first) / static_cast<Scalar>(n);
    Scalar largest = 0, i = 0;
    for (Scalar& x : result.sums_) {
      x = (x * scale - first) - i++ * step;
      largest = (std::max)(largest, std::abs(x));
    }
    result.unit_ *= rate;
    splinertia::detail::require(splinertia::detail::is_finite(result.unit_), "Allan analysis", "rate", rate,
                                "one at which the rate signal does not overflow");
    result.mean_ = step * result.unit_;
    // A straight line, to within the rounding of its values.
    if (largest <= 8 * std::numeric_limits<Scalar>::epsilon()) refuse_constant(result.mean_);
    return result;
  }

  /// n, the number of samples of the rate signal.
  [[nodiscard]] std::int64_t samples() const { return static_cast<std::int64_t>(sums_.size()) - 1; }
  [[nodiscard]] Scalar rate() const { return rate_; }  ///< Hz
  [[nodiscard]] Scalar mean() const { return mean_; }  ///< of the rate signal, in its unit
  [[nodiscard]] Scalar duration() const { return static_cast<Scalar>(samples()) / rate_; }  ///< n/rate, s
  /// x_0 … x_n in units of unit(). Times the sampling interval, they are the integral.
  [[nodiscard]] const std::vector<Scalar>& sums() const { return sums_; }
  /// The unit of the sums, in the unit of the rate signal: near the largest |y_i|, so that squares of sums are
  /// representable whatever the signal's unit is. From an integral: near rate times the largest of its values.
  [[nodiscard]] Scalar unit() const { return unit_; }

 private:
  explicit IntegratedSignal(Scalar rate) : rate_(rate) {}

  /// Stores the values in sums_ after this many zeros, checks them, sets the unit and returns their number.
  template <Signal S>
  std::size_t read(const S& values, std::ptrdiff_t fewest, std::size_t zeros) {
    splinertia::detail::require_positive("Allan analysis", "rate", rate_);
    const std::ptrdiff_t count = std::distance(std::begin(values), std::end(values));
    if (count < fewest) {
      splinertia::detail::refuse<std::invalid_argument>("Allan analysis: ", count, " values, expected at least ",
                                                        fewest);
    }
    const auto n = static_cast<std::size_t>(count);
    // Identification tries times up to max(64, 8 n)/rate (model_likelihood.hpp) and forms 2 n·rate for its frequencies.
    const Scalar most_intervals = 64 * static_cast<Scalar>(n);
    splinertia::detail::require(
        splinertia::detail::is_finite(most_intervals / rate_) && splinertia::detail::is_finite(most_intervals * rate_),
        "Allan analysis", "rate", rate_, "one at which the times and frequencies of the signal are representable");
    sums_.reserve(zeros + n);
    sums_.assign(zeros, Scalar(0));
    sums_.insert(sums_.end(), std::begin(values), std::end(values));
    constexpr Scalar most = (std::numeric_limits<Scalar>::max)();
    const auto magnitude = [y = sums_.data()](std::size_t i) {
      const Scalar size = std::abs(y[i]);
      return size <= most ? size : std::numeric_limits<Scalar>::infinity();
    };
    const Scalar largest = reduce(sums_.size(), magnitude, [](Scalar a, Scalar b) { return a < b ? b : a; });
    if (largest > most) refuse_not_finite(values);
    constexpr int limit = std::numeric_limits<Scalar>::max_exponent - 2;
    const int exponent = largest > 0 ? std::clamp(std::ilogb(largest) + 1, -limit, limit) : 0;
    unit_ = std::ldexp(Scalar(1), exponent);
    per_unit_ = std::ldexp(Scalar(1), -exponent);
    return n;
  }

  /// Σ y in units of unit(), accurate to a few eps: a compensated sum of plain sums over short pieces.
  [[nodiscard]] Scalar scaled_sum() const {
    constexpr std::size_t piece = 256;
    detail::CompensatedSum<Scalar> sum;
    for (std::size_t begin = 0; begin < sums_.size(); begin += piece) {
      const auto value = [y = sums_.data() + begin, scale = per_unit_](std::size_t i) { return y[i] * scale; };
      sum.add(reduce((std::min)(piece, sums_.size() - begin), value, std::plus<Scalar>()));
    }
    return sum.value();
  }

  /// Folds all values with `combine`, starting from zero. Sixteen results are computed side by side, which compilers
  /// vectorise.
  template <typename Value, typename Combine>
  [[nodiscard]] static Scalar reduce(std::size_t count, const Value& value, const Combine& combine) {
    constexpr std::size_t lanes = 16;
    std::array<Scalar, lanes> results{};
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
      for (std::size_t k = 0; k < lanes; ++k) results[k] = combine(results[k], value(i + k));
    }
    Scalar result = 0;
    for (; i < count; ++i) result = combine(result, value(i));
    for (const Scalar& of_lane : results) result = combine(result, of_lane);
    return result;
  }

  template <Signal S>
  [[noreturn]] static void refuse_not_finite(const S& values) {
    std::int64_t index = 0;
    auto value = std::begin(values);
    for (; splinertia::detail::is_finite(static_cast<Scalar>(*value)); ++value) ++index;
    splinertia::detail::refuse<std::invalid_argument>("Allan analysis: value ", index, " is ", *value,
                                                      ", expected a finite number");
  }

  [[noreturn]] static void refuse_constant(Scalar value) {
    splinertia::detail::refuse<std::invalid_argument>("Allan analysis: the signal is constant (", value,
                                                      "): a sensor that is stuck, or no noise at all");
  }

  Scalar rate_;
  Scalar mean_{0};
  Scalar unit_{1};
  Scalar per_unit_{1};
  std::vector<Scalar> sums_;
};

template <Signal S, typename Rate>
IntegratedSignal(const S&, Rate) -> IntegratedSignal<detail::ScalarOfSignal<S>>;

}  // namespace splinertia::allan

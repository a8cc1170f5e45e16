// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/require.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

namespace splinertia::allan {

/// The averaging factors m of a curve, in samples. The averaging time is tau = m/rate.
class AveragingFactors {
 public:
  /// `per_octave` (1 to 1000) factors an octave, equally spaced on a logarithmic axis. From the first power of two >=
  /// 16 and >= 4·per_octave on, the double of each factor is a factor too. Second differences over m and 2m then read
  /// the same sums, which makes this grid faster than one of any other ratio.
  [[nodiscard]] static AveragingFactors logarithmic(int per_octave = 5) {
    splinertia::detail::require(per_octave >= 1 && per_octave <= 1000, "AveragingFactors::logarithmic", "per_octave",
                                per_octave, "1 to 1000");
    return {Grid::logarithmic, per_octave};
  }
  [[nodiscard]] static AveragingFactors octave() { return {Grid::logarithmic, 1}; }  ///< 1, 2, 4, 8 …
  [[nodiscard]] static AveragingFactors decade() { return {Grid::decade, 0}; }       ///< 1, 2, 4, 10, 20, 40, 100 …
  [[nodiscard]] static AveragingFactors all() { return {Grid::all, 0}; }             ///< 1, 2, 3 …
  /// These factors. up_to() sorts them and throws std::invalid_argument if one is not within the data.
  [[nodiscard]] static AveragingFactors given(std::vector<std::int64_t> factors) {
    AveragingFactors result{Grid::given, 0};
    result.given_ = std::move(factors);
    return result;
  }
  /// The factors nearest to these averaging times [s], each at least half a sampling interval.
  template <typename Scalar>
  [[nodiscard]] static AveragingFactors taus(const std::vector<Scalar>& seconds, Scalar rate) {
    splinertia::detail::require_positive("AveragingFactors::taus", "rate", rate);
    std::vector<std::int64_t> factors;
    for (const Scalar& tau : seconds) {
      const Scalar m = tau * rate;
      splinertia::detail::require(m >= Scalar(1) / 2 && m < Scalar(std::int64_t{1} << 53), "AveragingFactors::taus",
                                  "tau", tau, "at least half a sampling interval");
      factors.push_back(static_cast<std::int64_t>(std::llround(m)));
    }
    return given(std::move(factors));
  }

  /// The factors from 1 to `largest`, in ascending order.
  [[nodiscard]] std::vector<std::int64_t> up_to(std::int64_t largest) const {
    std::vector<std::int64_t> result;
    if (grid_ == Grid::given) {
      for (const std::int64_t m : given_) {
        if (m < 1 || m > largest) {
          splinertia::detail::refuse<std::invalid_argument>("Allan analysis: averaging factor ", m,
                                                            " is outside the data, expected 1 to ", largest);
        }
      }
      result = given_;
    } else if (grid_ == Grid::all) {
      for (std::int64_t m = 1; m <= largest; ++m) result.push_back(m);
    } else if (grid_ == Grid::decade) {
      for (std::int64_t ten = 1; ten <= largest; ten *= 10) {
        for (const std::int64_t m : {ten, 2 * ten, 4 * ten}) {
          if (m <= largest) result.push_back(m);
        }
      }
    } else {
      // One octave of integers, fine enough for all to be different, shifted through all octaves.
      int bits = 4;
      while ((1 << bits) < 4 * per_octave_) ++bits;
      for (int octave = 0; octave < 62 && (std::int64_t{1} << octave) <= largest; ++octave) {
        for (int j = 0; j < per_octave_; ++j) {
          const auto base = std::llround(std::exp2(bits + static_cast<double>(j) / per_octave_));
          const std::int64_t m =
              octave >= bits ? base << (octave - bits) : (base + (1LL << (bits - octave - 1))) >> (bits - octave);
          if (m <= largest) result.push_back(m);
        }
      }
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }

 private:
  enum class Grid { logarithmic, decade, all, given };

  AveragingFactors(Grid grid, int per_octave) : grid_(grid), per_octave_(per_octave) {}

  Grid grid_;
  int per_octave_;
  std::vector<std::int64_t> given_;
};

}  // namespace splinertia::allan

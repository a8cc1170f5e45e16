// SPDX-License-Identifier: MIT
/// What the deviations of a signal must be: from their definitions in exact integer arithmetic, and from others'
/// tables.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <random>
#include <splinertia/allan/deviations.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace splinertia::testing {

using namespace splinertia::detail;

using Integers = std::vector<std::int64_t>;
__extension__ typedef __int128 Wide;

using AllDeviations = std::tuple<allan::AllanDeviation, allan::OverlappingAllanDeviation, allan::ModifiedAllanDeviation,
                                 allan::TimeDeviation, allan::HadamardDeviation, allan::OverlappingHadamardDeviation,
                                 allan::TotalDeviation>;

/// check.template operator()<D>() for all seven.
void for_each_deviation(const auto& check) {
  [&]<typename... D>(std::tuple<D...>*) {
    (check.template operator()<D>(), ...);
  }(static_cast<AllDeviations*>(nullptr));
}

/// x_0 = 0, x_{i+1} = x_i + y_i.
[[nodiscard]] inline Integers phase_of(const Integers& rates) {
  Integers phase{0};
  for (const std::int64_t y : rates) phase.push_back(phase.back() + y);
  return phase;
}

/// The second (third) difference of the phase over steps of m from i.
[[nodiscard]] inline std::int64_t difference(const Integers& x, std::int64_t i, std::int64_t m, int order) {
  const auto at = [&](std::int64_t k) { return x[static_cast<std::size_t>(i + k * m)]; };
  return order == 2 ? at(2) - 2 * at(1) + at(0) : at(3) - 3 * at(2) + 3 * at(1) - at(0);
}

[[nodiscard]] inline Wide squared(std::int64_t x) { return static_cast<Wide>(x) * x; }

/// What the library's sums of squares are of, from their definitions; at each `stride`-th place. With m near 16 % of
/// 10⁶ samples of ±10⁴ all intermediate results are within 2¹²⁷.
[[nodiscard]] inline Wide sum_of_squares(const Integers& x, std::int64_t m, int order, std::int64_t stride) {
  Wide sum = 0;
  for (std::int64_t i = 0; i + order * m < std::ssize(x); i += stride) sum += squared(difference(x, i, m, order));
  return sum;
}

/// Of Σ_{i=j}^{j+m−1} of the second differences.
[[nodiscard]] inline Wide modified_sum_of_squares(const Integers& x, std::int64_t m) {
  std::int64_t inner = 0;
  for (std::int64_t i = 0; i < m; ++i) inner += difference(x, i, m, 2);
  Wide sum = squared(inner);
  for (std::int64_t j = 0; j + 3 * m < std::ssize(x); ++j) {
    inner += difference(x, j + m, m, 2) - difference(x, j, m, 2);
    sum += squared(inner);
  }
  return sum;
}

/// Of the second differences about the points of x but its ends, of x continued by reflection about these.
[[nodiscard]] inline Wide total_sum_of_squares(const Integers& x, std::int64_t m) {
  const auto n = std::ssize(x) - 1;
  const auto at = [&](std::int64_t i) {
    const auto inside = [&](std::int64_t k) { return x[static_cast<std::size_t>(k)]; };
    return i < 0 ? 2 * inside(0) - inside(-i) : i > n ? 2 * inside(n) - inside(2 * n - i) : inside(i);
  };
  Wide sum = 0;
  for (std::int64_t i = 1; i < n; ++i) sum += squared(at(i - m) - 2 * at(i) + at(i + m));
  return sum;
}

/// Of the rates of a phase: SP 1065, equations 7 to 25. Rounded to long double in the last step only.
template <allan::Deviation D>
[[nodiscard]] long double exact_deviation(const Integers& x, std::int64_t m, long double rate) {
  const std::int64_t n = std::ssize(x) - 1;
  const auto root = [&](Wide sum, std::int64_t terms, int divisor) {
    return std::sqrt(static_cast<long double>(sum) / static_cast<long double>(divisor * terms)) /
           static_cast<long double>(m);
  };
  if constexpr (std::same_as<D, allan::AllanDeviation>) return root(sum_of_squares(x, m, 2, m), n / m - 1, 2);
  if constexpr (std::same_as<D, allan::OverlappingAllanDeviation>) {
    return root(sum_of_squares(x, m, 2, 1), n - 2 * m + 1, 2);
  }
  if constexpr (std::same_as<D, allan::HadamardDeviation>) return root(sum_of_squares(x, m, 3, m), n / m - 2, 6);
  if constexpr (std::same_as<D, allan::OverlappingHadamardDeviation>) {
    return root(sum_of_squares(x, m, 3, 1), n - 3 * m + 1, 6);
  }
  if constexpr (std::same_as<D, allan::TotalDeviation>) return root(total_sum_of_squares(x, m), n - 1, 2);
  const long double modified = root(modified_sum_of_squares(x, m), n - 3 * m + 2, 2) / static_cast<long double>(m);
  if constexpr (std::same_as<D, allan::TimeDeviation>) {
    return modified * static_cast<long double>(m) / rate / std::sqrt(3.0L);
  }
  return modified;
}

/// Rates in units of the last digit: an offset, white noise, and a random walk.
[[nodiscard]] inline Integers noisy_integers(std::size_t n, std::int64_t offset, double white, double walk) {
  std::mt19937_64 bits(20240501);
  std::normal_distribution<double> normal;
  Integers result(n);
  double drift = 0;
  for (auto& y : result) {
    drift += walk * normal(bits);
    y = offset + std::llround(white * normal(bits) + drift);
  }
  return result;
}

/// The same as floating-point numbers, in multiples of `unit`.
template <typename Scalar>
[[nodiscard]] std::vector<Scalar> scaled(const Integers& integers, Scalar unit) {
  std::vector<Scalar> result;
  for (const std::int64_t y : integers) result.push_back(static_cast<Scalar>(y) * unit);
  return result;
}

/// NIST SP 1065 (Riley 2008), section 12.4: 1000 rates between 0 and 1, in units of 1/nbs1000_unit.
inline constexpr std::int64_t nbs1000_unit = 2147483647;
[[nodiscard]] inline Integers nbs1000() {
  Integers result{1234567890};
  while (result.size() < 1000) result.push_back(16807 * result.back() % nbs1000_unit);
  return result;
}

/// A row of a table of Stable32 (W. J. Riley), which is not in this repository. lower and upper are 0 if not computed.
struct Stable32Row {
  std::int64_t m, terms;
  int alpha;
  double lower, sigma, upper;
};

[[nodiscard]] inline std::string stable32_folder() { return SPLINERTIA_TEST_DATA "/allan/"; }

/// The lines of a file there but its comments, one number or row each.
[[nodiscard]] inline std::vector<std::string> stable32_lines(const std::string& file) {
  std::ifstream input(stable32_folder() + file);
  if (!input) throw std::runtime_error(file + ": cannot be read");
  std::vector<std::string> lines;
  for (std::string line; std::getline(input, line);) {
    if (line.find_first_not_of(" \r\t") != std::string::npos && line[0] != '#') lines.push_back(line);
  }
  return lines;
}

[[nodiscard]] inline std::vector<double> stable32_numbers(const std::string& file) {
  std::vector<double> numbers;
  for (const std::string& line : stable32_lines(file)) numbers.push_back(std::stod(line));
  return numbers;
}

[[nodiscard]] inline std::vector<Stable32Row> stable32_rows(const std::string& file) {
  std::vector<Stable32Row> rows;
  for (const std::string& line : stable32_lines(file)) {
    std::istringstream numbers(line);
    Stable32Row row{};
    double tau = 0;
    if (!(numbers >> row.m >> tau >> row.terms >> row.alpha >> row.lower >> row.sigma >> row.upper)) {
      throw std::runtime_error(file + ": not a row: " + line);
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace splinertia::testing

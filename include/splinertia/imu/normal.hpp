// SPDX-License-Identifier: MIT
/// Normal random numbers, the same to the last bit on every compiler and platform (std::normal_distribution's algorithm
/// is the implementation's choice) and several times faster.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <splinertia/imu/random_stream.hpp>
#include <type_traits>

namespace splinertia {

/// a·b + c, rounded once at run time whatever the compiler is told about contraction. While compiling it rounds twice.
[[nodiscard]] constexpr double multiply_add(double a, double b, double c) {
  return std::is_constant_evaluated() ? a * b + c : std::fma(a, b, c);
}

/// log(x) for finite x > 0 in a fixed sequence of operations. Relative error a few eps.
[[nodiscard]] constexpr double reproducible_log(double x) {
  constexpr double ln2 = 0.693147180559945309417;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  int exponent = static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0x000fffffffffffffU) | 0x3ff0000000000000U);  // [1, 2)
  if (m > 1.4142135623730951) {
    m /= 2;
    ++exponent;
  }
  // log m = 2 artanh s, |s| < 0.172
  const double s = (m - 1) / (m + 1);
  const double s2 = s * s;
  double sum = 0;
  for (int n = 23; n >= 1; n -= 2) sum = multiply_add(sum, s2, 1.0 / n);
  return multiply_add(exponent, ln2, 2 * s * sum);
}

/// exp(x) for −100 < x <= 0 in a fixed sequence of operations. Relative error a few eps.
[[nodiscard]] constexpr double reproducible_exp(double x) {
  constexpr double ln2 = 0.693147180559945309417;
  const int n = static_cast<int>(x / ln2 - 0.5);
  const double r = multiply_add(-n, ln2, x);  // |r| <= ln2/2
  double sum = 1;
  for (int k = 14; k >= 1; --k) sum = multiply_add(sum, r / k, 1);
  return sum * std::bit_cast<double>(static_cast<std::uint64_t>(1023 + n) << 52);
}

/// The layers of the ziggurat: 255 rectangles and a base with the tail, all of the same area, under exp(−x²/2).
struct ZigguratTables {
  static constexpr std::size_t layers = 256;
  static constexpr double tail = 3.65415288536100877;        // where the tail begins
  static constexpr double area = 4.92867323397465534736e-3;  // of each layer
  std::array<double, layers + 1> x{};  // right edges, from the base up; x[0] is that of a rectangle of the base's area
  std::array<double, layers + 1> f{};  // exp(−x²/2)
  std::array<double, layers> scale{};  // x · 2⁻⁵³
};

[[nodiscard]] constexpr ZigguratTables make_ziggurat_tables() {
  constexpr auto square_root = [](double y) {  // Newton's iteration from above
    double root = y > 1 ? y : 1;
    for (double next = (root + y / root) / 2; next < root; next = (root + y / root) / 2) root = next;
    return root;
  };
  ZigguratTables t;
  t.x[1] = ZigguratTables::tail;
  t.f[1] = reproducible_exp(-t.x[1] * t.x[1] / 2);
  t.x[0] = ZigguratTables::area / t.f[1];
  for (std::size_t i = 2; i < ZigguratTables::layers; ++i) {
    t.f[i] = t.f[i - 1] + ZigguratTables::area / t.x[i - 1];
    t.x[i] = square_root(-2 * reproducible_log(t.f[i]));
  }
  t.f[ZigguratTables::layers] = 1;  // x = 0
  for (std::size_t i = 0; i < ZigguratTables::layers; ++i) t.scale[i] = t.x[i] * 0x1p-53;
  return t;
}

inline constexpr ZigguratTables ziggurat_tables = make_ziggurat_tables();

/// An endless stream of independent standard normal numbers, a function of its key alone.
/// Marsaglia, Tsang, "The Ziggurat Method for Generating Random Variables", J. Stat. Soft. 5 (2000), with layer, sign
/// and abscissa from bits of their own (Doornik, 2005).
class NormalStream {
 public:
  constexpr explicit NormalStream(StreamKey key) : bits_(key) {}

  constexpr double operator()() {
    while (true) {
      const std::uint64_t r = bits_();
      const std::size_t layer = r & 0xff;
      const std::uint64_t sign = (r & 0x100) << 55;
      const double x = static_cast<double>(static_cast<std::int64_t>(r >> 11)) * ziggurat_tables.scale[layer];
      if (x < ziggurat_tables.x[layer + 1]) return with_sign(x, sign);  // 99 % of all draws
      if (layer == 0) return with_sign(tail(), sign);
      const double f0 = ziggurat_tables.f[layer], f1 = ziggurat_tables.f[layer + 1];
      if (multiply_add(uniform(), f1 - f0, f0) < reproducible_exp(-x * x / 2)) return with_sign(x, sign);
    }
  }

  /// Uniform in [0, 1), 53 bits.
  constexpr double uniform() { return static_cast<double>(static_cast<std::int64_t>(bits_() >> 11)) * 0x1p-53; }

 private:
  // A branch on a random sign would be mispredicted every other time.
  static constexpr double with_sign(double x, std::uint64_t sign) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ sign);
  }

  // Marsaglia, "Generating a Variable from the Tail of the Normal Distribution", Technometrics 6 (1964).
  constexpr double tail() {
    while (true) {
      const double x = -reproducible_log(1 - uniform()) / ZigguratTables::tail;
      const double y = -reproducible_log(1 - uniform());
      if (2 * y > x * x) return ZigguratTables::tail + x;
    }
  }

  Xoshiro256 bits_;
};

}  // namespace splinertia

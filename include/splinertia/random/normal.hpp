// SPDX-License-Identifier: MIT
/// Normal random numbers, the same to the last bit on every compiler and platform. The algorithm of
/// std::normal_distribution differs from implementation to implementation; this one is also several times faster.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <splinertia/detail/inline.hpp>
#include <splinertia/random/detail/random_bits.hpp>
#include <splinertia/random/detail/reproducible_math.hpp>
#include <splinertia/random/random_stream.hpp>
#include <type_traits>

namespace splinertia {

namespace detail {

/// The layers of the ziggurat under exp(−x²/2): 255 rectangles, and a base with the tail, all of the same area.
struct ZigguratTables {
  static constexpr std::size_t layers = 256;
  static constexpr double tail = 3.65415288536100877;        // where the tail begins
  static constexpr double height = 1.260285930498598e-3;     // exp(−tail²/2)
  static constexpr double area = 4.92867323397465534736e-3;  // of each layer
  std::array<double, layers + 1> x{};  // right edges, from the base up; x[0]: of a rectangle with the area of the base
  std::array<double, layers + 1> f{};  // exp(−x²/2)
  // Indexed by the layer, + 256 for negative numbers. scale: ±x · 2⁻⁵³. inside: the smallest integer whose multiple of
  // that is not left of the edge of the layer above.
  std::array<double, 2 * layers> scale{};
  std::array<std::int64_t, 2 * layers> inside{};
};

[[nodiscard]] constexpr ZigguratTables make_ziggurat_tables() {
  constexpr auto square_root = [](double y) {  // Newton's iteration from above
    double root = y > 1 ? y : 1;
    for (double next = (root + y / root) / 2; next < root; next = (root + y / root) / 2) root = next;
    return root;
  };
  ZigguratTables t;
  t.x[1] = ZigguratTables::tail;
  t.f[1] = ZigguratTables::height;
  t.x[0] = ZigguratTables::area / t.f[1];
  for (std::size_t i = 2; i < ZigguratTables::layers; ++i) {
    t.f[i] = t.f[i - 1] + ZigguratTables::area / t.x[i - 1];
    t.x[i] = square_root(-2 * reproducible_log(t.f[i]));
  }
  t.f[ZigguratTables::layers] = 1;  // x = 0
  for (std::size_t i = 0; i < ZigguratTables::layers; ++i) {
    const double scale = t.x[i] * 0x1p-53, edge = t.x[i + 1];
    auto first = static_cast<std::int64_t>(edge / scale);
    while (first > 0 && !(static_cast<double>(first - 1) * scale < edge)) --first;
    while (static_cast<double>(first) * scale < edge) ++first;
    t.scale[i] = scale;
    t.scale[i + ZigguratTables::layers] = -scale;
    t.inside[i] = t.inside[i + ZigguratTables::layers] = first;
  }
  return t;
}

inline constexpr ZigguratTables ziggurat_tables = make_ziggurat_tables();

}  // namespace detail

/// An endless stream of independent standard normal numbers, determined by its key alone.
/// Marsaglia, Tsang, "The Ziggurat Method for Generating Random Variables", J. Stat. Soft. 5 (2000), with separate bits
/// for layer, sign and abscissa (Doornik, 2005).
/// Generator is any uniform random bit generator. Streams of the default one are the same on every platform.
template <BitGenerator Generator = Xoshiro256>
class NormalStream {
 public:
  constexpr explicit NormalStream(StreamKey key) : bits_(key) {}

  SPLINERTIA_ALWAYS_INLINE constexpr double operator()() {
    const std::uint64_t r = bits_();
    const Candidate candidate(r);
    if (candidate.inside()) [[likely]]
      return candidate.x();  // 99 % of all draws
    if constexpr (std::is_trivially_copyable_v<detail::RandomBits<Generator>>) {
      // Works on a copy: if a function that is not inlined knew the address of this object, it could not stay in
      // registers.
      NormalStream copy = *this;
      const double x = copy.go_on(r);
      *this = copy;
      return x;
    } else {
      return go_on(r);
    }
  }

  /// Uniform in [0, 1), 53 bits.
  SPLINERTIA_ALWAYS_INLINE constexpr double uniform() {
    return static_cast<double>(static_cast<std::int64_t>(bits_() >> 11)) * 0x1p-53;
  }

 private:
  // A point of a layer, from 64 bits: 8 for the layer, one for the sign, 53 for the abscissa.
  struct Candidate {
    std::size_t index;      // of the layer, + 256 for a negative x
    std::int64_t multiple;  // x in units of scale

    SPLINERTIA_ALWAYS_INLINE constexpr explicit Candidate(std::uint64_t r)
        : index(r & 0x1ff), multiple(static_cast<std::int64_t>(r >> 11)) {}
    /// Whether x is left of the edge of the layer above, so that the point is certainly under the curve.
    [[nodiscard]] SPLINERTIA_ALWAYS_INLINE constexpr bool inside() const {
      return multiple < detail::ziggurat_tables.inside[index];
    }
    [[nodiscard]] SPLINERTIA_ALWAYS_INLINE constexpr double x() const {
      return static_cast<double>(multiple) * detail::ziggurat_tables.scale[index];
    }
    [[nodiscard]] constexpr std::size_t layer() const { return index % detail::ZigguratTables::layers; }
    [[nodiscard]] constexpr double with_sign(double absolute) const {
      return index < detail::ZigguratTables::layers ? absolute : -absolute;
    }
  };

  // Continues when the candidate made from r is not inside. Not inlined, to keep it out of the loops that draw.
  SPLINERTIA_COLD constexpr double go_on(std::uint64_t r) {
    for (;; r = bits_()) {
      const Candidate candidate(r);
      const double x = candidate.x();
      if (candidate.inside()) return x;
      const std::size_t layer = candidate.layer();
      if (layer == 0) return candidate.with_sign(tail());
      const double f0 = detail::ziggurat_tables.f[layer], f1 = detail::ziggurat_tables.f[layer + 1];
      if (detail::multiply_add(uniform(), f1 - f0, f0) < detail::reproducible_exp(-x * x / 2)) return x;
    }
  }

  // Marsaglia, "Generating a Variable from the Tail of the Normal Distribution", Technometrics 6 (1964).
  constexpr double tail() {
    while (true) {
      const double x = -detail::reproducible_log(1 - uniform()) / detail::ZigguratTables::tail;
      const double y = -detail::reproducible_log(1 - uniform());
      if (2 * y > x * x) return detail::ZigguratTables::tail + x;
    }
  }

  detail::RandomBits<Generator> bits_;
};

NormalStream(StreamKey) -> NormalStream<>;

}  // namespace splinertia

// SPDX-License-Identifier: MIT
/// Evaluates a curve at several times at once: evaluate_increments() with a SIMD pack as its scalar (SimdPack, one time
/// per lane). The code and the order of its operations are those for a single time, so the results are bitwise equal if
/// every product and sum is rounded. With FMA the compiler may fuse different operations.
///
/// The samples of a segment share its control points and increments, so what depends only on these is computed once.
/// Nothing branches on a lane: rotations within a segment are at most π, where the coefficients are polynomials
/// (group/detail/stumpff.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <splinertia/detail/flatten.hpp>
#include <splinertia/group/with_scalar.hpp>
#include <splinertia/spline/evaluate.hpp>
#include <splinertia/time.hpp>

namespace splinertia::detail {

/// A curve that can be evaluated at several times at once: a spline in float or double over double or integer time, on
/// a group that supports SIMD packs, with knots that have segment().
template <typename C>
concept PackedCurve = (std::same_as<typename C::Scalar, float> || std::same_as<typename C::Scalar, double>) &&
                      (std::same_as<typename C::Time, double> || !std::floating_point<typename C::Time>) &&
                      HasSimdPack<typename C::Group, NativeSimdPack<typename C::Scalar>> && requires(const C& curve) {
                        curve.increments();
                        curve.knots().segment(curve.start(), std::size_t{}, C::order);
                      };

/// One segment of a curve, with the data that its samples share broadcast to SIMD packs.
template <PackedCurve C>
class PackedSegment {
 public:
  using Real = typename C::Scalar;
  using L = NativeSimdPack<Real>;
  using G = WithScalar<typename C::Group, L>;

  PackedSegment(const C& curve, std::size_t s)
      : first_(with_scalar<L>(curve.control_points()[s])), knots_(curve.knots(), s) {
    for (std::size_t j = 0; j < increments_.size(); ++j) {
      for (int i = 0; i < increments_[j].size(); ++i) increments_[j][i] = L(curve.increments()[s + j][i]);
    }
  }

  /// The motion at samples i, i + 1, …, one per lane. Samples after the end of the segment are extrapolated.
  template <int D>
  [[nodiscard]] Motion<G, D> evaluate(const auto& times, std::size_t i) const {
    return evaluate_increments<D>(
        first_, [this](std::size_t j) -> const Tangent<G>& { return increments_[j]; },
        knots_.template basis<D, Real>(packed_times(times, i)));
  }

 private:
  using TimePack = SimdPack<double, L::size, vector_bytes>;

  // In the form that the knots take: seconds, or ticks since the beginning of the segment.
  [[nodiscard]] TimePack packed_times(const auto& times, std::size_t i) const {
    if constexpr (requires { times.template lanes<TimePack>(i); }) {
      return times.template lanes<TimePack>(i);
    } else {
      std::array<double, L::size> t;
      for (std::size_t l = 0; l < t.size(); ++l) {
        if constexpr (std::floating_point<typename C::Time>) {
          t[l] = times(i + l);
        } else {
          t[l] = static_cast<double>(time_between(knots_.begin(), times(i + l)).count());
        }
      }
      return TimePack::load(t.data());
    }
  }

  G first_;
  std::array<Tangent<G>, C::order - 1> increments_;
  typename std::remove_cvref_t<decltype(std::declval<const C&>().knots())>::template Segment<C::order> knots_;
};

/// Calls write(i, motion) in ascending order of i to cover samples first … first + count − 1 at times(first), …. The
/// lanes of `motion` are samples i, i + 1, …. SimdPack after the last sample of a segment are invalid: a later call
/// overwrites them, or they are after the last sample of all. Requires all times on the curve, in ascending order; the
/// last may exceed its end by rounding.
template <int D, PackedCurve C>
inline void evaluate_packed(const C& curve, const auto& times, std::size_t first, std::size_t count,
                            const auto& write) {
  constexpr std::size_t lanes = PackedSegment<C>::L::size;
  const std::size_t points = curve.control_points().size(), end = first + count;
  const auto curve_end = curve.end();
  const auto segment_of = [&](std::size_t i) {
    return curve.knots().segment((std::min)(times(i), curve_end), points, C::order);
  };
  for (std::size_t i = first; i < end;) {
    const std::size_t s = segment_of(i);
    std::size_t segment_end = end;
    if (s + 1 < curve.segments()) {
      const double intervals = times.intervals(curve.knots().knot(s + 1, C::order) - times(i));
      if (intervals < static_cast<double>(end - i)) segment_end = i + 1 + static_cast<std::size_t>(intervals);
      segment_end = std::clamp(segment_end, i + 1, end);
      // The estimate is off by at most one. The knots decide which samples belong to the segment.
      while (segment_end > i + 1 && segment_of(segment_end - 1) != s) --segment_end;
      while (segment_end < end && segment_of(segment_end) == s) ++segment_end;
    }
    call_flattened([&] {
      // Copies, which write() cannot modify: so the compiler moves what depends only on them out of the loop.
      const PackedSegment<C> segment(curve, s);
      const auto at = times;
      const auto to = write;
      const std::size_t last = segment_end;
      for (std::size_t n = i; n < last; n += lanes) to(n, segment.template evaluate<D>(at, n));
      return 0;
    });
    i = segment_end;
  }
}

/// evaluate_packed() for any curve. Curves that are not LaneCurves are evaluated at one time after the other.
template <int D, typename C>
inline void for_each_sample(const C& curve, const auto& times, std::size_t first, std::size_t count,
                            const auto& write) {
  if constexpr (PackedCurve<C>) {
    evaluate_packed<D>(curve, times, first, count, write);
  } else {
    const auto end = curve.end();
    for (std::size_t i = first; i < first + count; ++i) {
      write(i, curve.template evaluate<D>(std::min<typename C::Time>(times(i), end)));
    }
  }
}

}  // namespace splinertia::detail

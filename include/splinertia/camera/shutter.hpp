// SPDX-License-Identifier: MIT
/// When the rows of an image are exposed, and which of these times the stamp of a frame is. The time of a row is the
/// middle of its exposure.
#pragma once

#include <concepts>
#include <splinertia/detail/require.hpp>

namespace splinertia {

/// All rows at once, at the time of the frame.
struct GlobalShutter {};

/// The time of a frame is that of row 0, the uppermost.
struct TopRow {};
/// The time of a frame is that of its middle, between row 0 and row height − 1.
struct MiddleRow {};
/// The time of a frame is that of row height − 1, the lowermost.
struct BottomRow {};
/// The time of a frame is when the exposure of the row that is read first begins.
template <typename Scalar = double>
struct ExposureStart {
  Scalar exposure;  ///< of each row, s; >= 0
};
template <typename Scalar>
ExposureStart(Scalar) -> ExposureStart<Scalar>;

/// Row by row: row v is read `line_delay` · v seconds after row 0, for continuous v. `Stamp` says which time the stamp of
/// a frame is: TopRow, MiddleRow, BottomRow or ExposureStart. Camera's constructor throws std::invalid_argument for
/// numbers that are not finite.
template <typename Scalar = double, typename Stamp = TopRow>
struct RollingShutter {
  Scalar line_delay;  ///< s; negative if the rows are read from the bottom to the top
  [[no_unique_address]] Stamp stamp{};
};
template <typename Scalar>
RollingShutter(Scalar) -> RollingShutter<Scalar>;
template <typename Scalar, typename Stamp>
RollingShutter(Scalar, Stamp) -> RollingShutter<Scalar, Stamp>;

namespace detail {

template <typename Shutter>
inline constexpr bool is_rolling = false;
template <typename Scalar, typename Stamp>
inline constexpr bool is_rolling<RollingShutter<Scalar, Stamp>> = true;

/// Rows from row 0 to the row at the time of the frame, and the rest of the time between these two, s.
template <typename Scalar>
struct StampOffset {
  Scalar rows;
  Scalar seconds;
};

template <typename Scalar>
[[nodiscard]] StampOffset<Scalar> stamp_offset(const TopRow&, const Scalar&, int) {
  return {Scalar(0), Scalar(0)};
}
template <typename Scalar>
[[nodiscard]] StampOffset<Scalar> stamp_offset(const MiddleRow&, const Scalar&, int height) {
  return {Scalar(height - 1) / Scalar(2), Scalar(0)};
}
template <typename Scalar>
[[nodiscard]] StampOffset<Scalar> stamp_offset(const BottomRow&, const Scalar&, int height) {
  return {Scalar(height - 1), Scalar(0)};
}
template <typename Scalar, typename Seconds>
[[nodiscard]] StampOffset<Scalar> stamp_offset(const ExposureStart<Seconds>& stamp, const Scalar& line_delay,
                                               int height) {
  return {line_delay < Scalar(0) ? Scalar(height - 1) : Scalar(0), Scalar(stamp.exposure) / Scalar(2)};
}

inline void check_shutter(const GlobalShutter&) {}
template <typename Scalar, typename Stamp>
void check_shutter(const RollingShutter<Scalar, Stamp>& shutter) {
  require_finite("RollingShutter", "line_delay", shutter.line_delay);
  if constexpr (requires { shutter.stamp.exposure; }) {
    require_non_negative("ExposureStart", "exposure", shutter.stamp.exposure);
  }
}

}  // namespace detail

}  // namespace splinertia

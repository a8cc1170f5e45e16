// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <splinertia/detail/require.hpp>

namespace splinertia {

/// The size of an image in pixels. Pixels are continuous: u in [0, width) from left to right, v in [0, height) from top
/// to bottom. v is the row.
struct ImageSize {
  int width, height;

  /// Throws std::invalid_argument unless both are positive.
  constexpr ImageSize(int image_width, int image_height) : width(image_width), height(image_height) {
    detail::require(width > 0, "ImageSize", "width", width, "at least 1 pixel");
    detail::require(height > 0, "ImageSize", "height", height, "at least 1 pixel");
  }

  /// Whether a pixel is in the image. False for NaN.
  template <typename Scalar>
  [[nodiscard]] bool contains(const Eigen::Vector2<Scalar>& pixel) const {
    return pixel.x() >= Scalar(0) && pixel.x() < Scalar(width) && pixel.y() >= Scalar(0) && pixel.y() < Scalar(height);
  }

  friend constexpr bool operator==(const ImageSize&, const ImageSize&) = default;
};

}  // namespace splinertia

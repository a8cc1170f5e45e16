// SPDX-License-Identifier: MIT
/// The part of an image in which a camera sees landmarks. A region has
///   region.contains(pixel)   whether a pixel inside the image is part of it
/// and, where it depends on the size of the image, region.check(size), which throws std::invalid_argument.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <splinertia/camera/image_size.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/require.hpp>
#include <stdexcept>
#include <utility>
#include <vector>

namespace splinertia {

/// All of the image. Costs nothing.
struct WholeImage {
  [[nodiscard]] constexpr bool contains(const auto&) const { return true; }
};

/// A circle, as the lens of a fisheye camera projects it. All values are in pixels.
template <typename Scalar = double>
class ImageCircle {
 public:
  /// Throws std::invalid_argument unless all numbers are finite and the radius is positive.
  ImageCircle(const Scalar& u, const Scalar& v, const Scalar& radius) : centre_(u, v), square_(radius * radius) {
    detail::require_finite("ImageCircle", "u", u);
    detail::require_finite("ImageCircle", "v", v);
    detail::require_positive("ImageCircle", "radius", radius);
  }
  template <typename Other>
  [[nodiscard]] bool contains(const Eigen::Vector2<Other>& pixel) const {
    const Other x = pixel.x() - Other(centre_.x()), y = pixel.y() - Other(centre_.y());
    return x * x + y * y < Other(square_);
  }

 private:
  Eigen::Vector2<Scalar> centre_;
  Scalar square_;
};

template <typename Scalar>
ImageCircle(Scalar, Scalar, Scalar) -> ImageCircle<Scalar>;

/// A mask with one value for each pixel, row by row. True: landmarks are seen there. Pixel (i, j) has u in [i, i + 1)
/// and v in [j, j + 1).
class ImageMask {
 public:
  /// Throws std::invalid_argument unless there are width · height values.
  ImageMask(ImageSize size, std::vector<bool> seen) : size_(size), seen_(std::move(seen)) {
    const std::size_t pixels = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    if (seen_.size() == pixels) return;
    detail::refuse<std::invalid_argument>("ImageMask: the number of values is ", seen_.size(), ", expected ", pixels,
                                          " = width * height");
  }
  void check(ImageSize image) const {
    if (image == size_) return;
    detail::refuse<std::invalid_argument>("ImageMask: size is ", size_.width, " x ", size_.height, ", expected ",
                                          image.width, " x ", image.height, " as the image");
  }
  template <typename Scalar>
  [[nodiscard]] bool contains(const Eigen::Vector2<Scalar>& pixel) const {
    const auto i = static_cast<std::size_t>(pixel.x()), j = static_cast<std::size_t>(pixel.y());
    return seen_[j * static_cast<std::size_t>(size_.width) + i];
  }

 private:
  ImageSize size_;
  std::vector<bool> seen_;
};

}  // namespace splinertia

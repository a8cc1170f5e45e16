// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <splinertia/group/lie_group.hpp>
#include <splinertia/message.hpp>
#include <stdexcept>

namespace splinertia {

/// A parameter of a three-axis sensor: one value for all axes or one for each.
template <typename Scalar>
class PerAxis {
 public:
  constexpr PerAxis(Scalar all) : values_{all, all, all} {}
  constexpr PerAxis(Scalar x, Scalar y, Scalar z) : values_{x, y, z} {}
  PerAxis(const Vector3<Scalar>& v) : values_{v.x(), v.y(), v.z()} {}

  [[nodiscard]] constexpr Scalar operator[](std::size_t axis) const { return values_[axis]; }

  /// Throws std::invalid_argument unless every value is finite and >= 0.
  constexpr const PerAxis& require_non_negative(const char* term, const char* parameter) const {
    for (const Scalar value : values_) {
      if (!(value >= Scalar(0) && value <= std::numeric_limits<Scalar>::max())) {
        throw std::invalid_argument(message(term, ": ", parameter, " is ", value, ", expected a finite number >= 0"));
      }
    }
    return *this;
  }

 private:
  std::array<Scalar, 3> values_;
};

}  // namespace splinertia

// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <splinertia/time.hpp>

namespace splinertia {

/// A landmark in an image.
template <typename Scalar = double, TimePoint Time = double>
struct Observation {
  Eigen::Vector2<Scalar> pixel;  ///< (u, v); v is the row
  Time time;                     ///< when the row was exposed, to the nearest tick
  Scalar row_offset;             ///< the same in seconds after the time of the frame, not rounded to ticks
};

/// All observations of a landmark in one frame, in the order of time: a range, at most `Capacity` long, without heap.
template <typename Element, std::size_t Capacity>
class Observations {
 public:
  [[nodiscard]] const Element* begin() const { return elements_.data(); }
  [[nodiscard]] const Element* end() const { return elements_.data() + size_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] const Element& operator[](std::size_t i) const { return elements_[i]; }
  [[nodiscard]] const Element& front() const { return elements_[0]; }
  [[nodiscard]] const Element& back() const { return elements_[size_ - 1]; }
  [[nodiscard]] static constexpr std::size_t capacity() { return Capacity; }

  /// Appends an element; does nothing if `Capacity` is reached.
  void push_back(const Element& element) {
    if (size_ < Capacity) elements_[size_++] = element;
  }

 private:
  std::array<Element, Capacity> elements_;
  std::size_t size_ = 0;
};

}  // namespace splinertia

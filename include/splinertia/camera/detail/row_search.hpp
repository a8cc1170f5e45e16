// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/camera/camera_model.hpp>
#include <splinertia/camera/detail/frame_poses.hpp>
#include <splinertia/camera/detail/row_cubic.hpp>
#include <splinertia/camera/image_size.hpp>
#include <splinertia/camera/observation.hpp>

namespace splinertia::detail {

/// A landmark as it is seen when one row is read. A solution is a row where `excess` is zero.
template <typename Scalar>
struct RowSample {
  Scalar row;
  bool valid;                            ///< the point is in the model's domain
  Eigen::Vector3<Scalar> point, moves;   ///< in the camera, and its change per row
  Eigen::Vector2<Scalar> pixel, slides;  ///< and its change per row
  Scalar excess;                         ///< row − pixel.y()
  Scalar slope;                          ///< of `excess`, per row
};

/// Finds all rows of a frame in which a landmark appears while they are read. The excess is bracketed between the poses
/// of the frame, split where a cubic through its values and slopes may turn, and solved by Newton's method in the
/// bracket.
template <typename Curve, typename Camera>
class RowSearch {
 public:
  using Scalar = typename Camera::Scalar;
  using Sample = RowSample<Scalar>;
  using Observed = Observation<Scalar, typename Curve::Time>;
  using Result = Observations<Observed, 8>;

  RowSearch(const FramePoses<Curve, Camera>& poses, const Eigen::Vector3<Scalar>& landmark)
      : poses_(poses), landmark_(landmark), height_(static_cast<Scalar>(poses.camera().size().height)) {}

  [[nodiscard]] Result run() {
    Sample a = sample(poses_[0]);
    if (a.valid && a.excess == Scalar(0)) {
      record(a, Scalar(0));
      const Scalar small = (std::numeric_limits<Scalar>::min)();
      a.excess = a.slope < Scalar(0) ? -small : small;
    }
    for (std::size_t i = 1; i <= poses_.intervals(); ++i) {
      const Sample b = sample(poses_[i]);
      search(a, b, 0);
      a = b;
    }
    if (poses_.times().line_delay < Scalar(0)) reverse();
    return found_;
  }

 private:
  static constexpr int most_splits = 40;

  [[nodiscard]] Sample sample(const RowState<Scalar>& state) const {
    const Scalar& delay = poses_.times().line_delay;
    Sample s;
    s.row = state.row;
    s.point = state.camera.in_camera(landmark_);
    const Eigen::Vector3<Scalar> rate = state.camera.rate(s.point);
    s.point += rate * state.rest;
    s.moves = rate * delay;
    const auto p = poses_.camera().model().template linearize<Wrt::point>(s.point);
    s.valid = p.has_value();
    if (s.valid) {
      s.pixel = p->pixel;
      s.slides = p->point_jacobian * s.moves;
      s.excess = s.row - s.pixel.y();
      s.slope = Scalar(1) - s.slides.y();
    }
    return s;
  }
  [[nodiscard]] Sample sample(const Scalar& row) const { return sample(poses_.at(row)); }

  void search(const Sample& a, const Sample& b, int splits) {
    if (splits < 12 && moves_far(a, b)) return halve(a, b, splits);
    if (a.valid && b.valid) return isolate(a, b, splits);
    if (a.valid || b.valid) {
      const bool forward = a.valid;
      if (splits < most_splits && !leaves_image(forward ? a : b, forward ? Scalar(1) : Scalar(-1))) halve(a, b, splits);
      return;
    }
    if (splits > 0) return;
    const Scalar length = b.row - a.row;
    const Eigen::Vector3<Scalar> middle = (a.point + b.point) / Scalar(2) + (a.moves - b.moves) * (length / Scalar(8));
    if (poses_.camera().model().project(middle)) halve(a, b, splits);
  }

  void split(const Sample& a, const Sample& b, const Scalar& row, int splits) {
    const Sample m = sample(row);
    search(a, m, splits + 1);
    search(m, b, splits + 1);
  }
  void halve(const Sample& a, const Sample& b, int splits) { split(a, b, (a.row + b.row) / Scalar(2), splits); }

  /// The direction to the point changes so much that a cubic does not describe the pixel.
  [[nodiscard]] static bool moves_far(const Sample& a, const Sample& b) {
    const Scalar nearest = (std::min)(a.point.squaredNorm(), b.point.squaredNorm());
    return (b.point - a.point).squaredNorm() > nearest * (Scalar(9) / Scalar(100));
  }

  /// The pixel is outside the image and moves away from it.
  [[nodiscard]] bool leaves_image(const Sample& s, const Scalar& direction) const {
    const auto leaves = [&](const Scalar& x, const Scalar& slide, int size) {
      return (x < Scalar(0) && slide * direction < Scalar(0)) || (x >= Scalar(size) && slide * direction > Scalar(0));
    };
    const ImageSize& size = poses_.camera().size();
    return leaves(s.pixel.x(), s.slides.x(), size.width) || leaves(s.pixel.y(), s.slides.y(), size.height);
  }

  /// Both points are in the domain: finds what is between them.
  void isolate(const Sample& a, const Sample& b, int splits) {
    const Scalar length = b.row - a.row;
    const HermiteCubic<Scalar> cubic(a.excess, a.slope * length, b.excess, b.slope * length);
    const bool changes = (a.excess < Scalar(0)) != (b.excess < Scalar(0));
    const auto extrema = cubic.extrema();
    if (extrema.count > 0 && splits < most_splits) {
      using std::abs;
      const Scalar variation =
          (std::max)({Scalar(abs(cubic.c1)), Scalar(abs(b.slope * length)), Scalar(abs(b.excess - a.excess))});
      const Scalar nearest = Scalar(4) * std::numeric_limits<Scalar>::epsilon() * height_ / length;
      int signs = 0;
      Scalar before = a.excess;
      for (std::size_t i = 0; i < extrema.count; ++i) {
        const Scalar& x = extrema.x[i];
        if ((std::min)(x, Scalar(1) - x) < nearest) continue;
        // The error of the cubic grows with the square of the distances from its ends.
        const Scalar share = Scalar(4) * x * (Scalar(1) - x), value = cubic.value(x);
        if (abs(value) <= share * share * variation / Scalar(10)) return split(a, b, a.row + x * length, splits);
        if ((value < Scalar(0)) != (before < Scalar(0)) && ++signs == 1 + (changes ? 1 : 0)) {
          return split(a, b, a.row + extrema.x[0] * length, splits);
        }
        before = value;
      }
    }
    if (changes && !misses(a, b)) solve(a, b, cubic);
  }

  /// The pixel is far left or right of the image.
  [[nodiscard]] bool misses(const Sample& a, const Sample& b) const {
    using std::abs;
    const Scalar margin = Scalar(abs(b.pixel.x() - a.pixel.x())) +
                          (b.row - a.row) * (std::max)(Scalar(abs(a.slides.x())), Scalar(abs(b.slides.x())));
    const auto width = static_cast<Scalar>(poses_.camera().size().width);
    return (std::max)(a.pixel.x(), b.pixel.x()) < -margin || (std::min)(a.pixel.x(), b.pixel.x()) > width + margin;
  }

  /// The excess has different signs at a and b.
  void solve(const Sample& a, const Sample& b, const HermiteCubic<Scalar>& cubic) {
    using std::abs;
    const Scalar length = b.row - a.row, resolution = std::numeric_limits<Scalar>::epsilon() * height_;
    const Scalar curvature = cubic.curvature() / (length * length);
    const bool rises = a.excess < Scalar(0);
    Scalar low = a.row, high = b.row, row = low + cubic.root() * length;
    for (int i = 0; i < 100; ++i) {
      const Sample s = sample(row);
      if (!s.valid) return;
      const Scalar step = -s.excess / s.slope;
      // What is left after this step, from the second derivatives of the pixel.
      const Scalar left = (curvature + s.slides.squaredNorm() / height_) * step * step;
      if (left <= resolution / Scalar(4) * abs(s.slope) || high - low <= resolution) {
        return record(s, high - low <= resolution ? Scalar(0) : step);
      }
      ((s.excess < Scalar(0)) == rises ? low : high) = row;
      row += step;
      if (!(low <= row && row <= high) || i % 4 == 3) row = low + (high - low) / Scalar(2);
    }
    const Sample s = sample(row);
    if (s.valid) record(s, Scalar(0));
  }

  /// Notes the solution `step` rows after s, if it is in the image.
  void record(const Sample& s, const Scalar& step) {
    const Scalar row = s.row + step;
    const Eigen::Vector2<Scalar> pixel(s.pixel.x() + s.slides.x() * step, row);
    if (!poses_.camera().sees(pixel)) return;
    using std::abs;
    if (!found_.empty() &&
        abs(found_.back().pixel.y() - row) <= Scalar(2) * std::numeric_limits<Scalar>::epsilon() * height_) {
      return;
    }
    found_.push_back({pixel, poses_.time(row).time, poses_.times().offset(row)});
  }

  void reverse() {
    Result reversed;
    for (std::size_t i = found_.size(); i-- > 0;) reversed.push_back(found_[i]);
    found_ = reversed;
  }

  const FramePoses<Curve, Camera>& poses_;
  const Eigen::Vector3<Scalar>& landmark_;
  Scalar height_;
  Result found_;
};

}  // namespace splinertia::detail

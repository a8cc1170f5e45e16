// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <splinertia/camera/camera_model.hpp>
#include <splinertia/camera/image_size.hpp>
#include <splinertia/camera/observation.hpp>
#include <splinertia/detail/finite.hpp>

namespace splinertia::detail {

/// Finds the parts of a segment that a camera sees. Its points have the directions α e₀ + β e₁, where e₀ and e₁ are those
/// to its ends. Directions are sampled every 0.1 rad, and more densely wherever a border of the image may be crossed.
template <typename Camera, typename Part>
class SegmentClip {
 public:
  using Scalar = typename Camera::Scalar;
  using Vector3 = Eigen::Vector3<Scalar>;
  using Parts = Observations<Part, 8>;

  /// The ends are in the camera frame.
  SegmentClip(const Camera& camera, const Vector3& first, const Vector3& last)
      : camera_(camera), norms_{first.stableNorm(), last.stableNorm()}, e0_(first / norms_[0]), e1_(last / norms_[1]) {}

  [[nodiscard]] Parts run() {
    if (!all_finite(e0_) || !all_finite(e1_)) return parts_;
    using std::atan2, std::sin;
    const Scalar sine = e0_.cross(e1_).norm(), cosine = e0_.dot(e1_), angle = atan2(sine, cosine);
    const Scalar epsilon = std::numeric_limits<Scalar>::epsilon();
    if (cosine < Scalar(0) && !(sine > Scalar(64) * epsilon)) return parts_;  // it passes through the camera
    const int intervals = 1 + static_cast<int>(angle * Scalar(10));
    Sample a = sample(Scalar(1), Scalar(0));
    if (a.visible) cross(a);
    for (int i = 1; i <= intervals; ++i) {
      const Scalar turned = angle * static_cast<Scalar>(i) / static_cast<Scalar>(intervals);
      const Sample b = i < intervals ? sample(Scalar(sin(angle - turned) / sine), Scalar(sin(turned) / sine))
                                     : sample(Scalar(0), Scalar(1));
      search(a, b, 0);
      a = b;
    }
    if (a.visible) cross(a);
    return parts_;
  }

 private:
  static constexpr int most_splits = 24;

  struct Sample {
    Scalar alpha, beta;
    bool valid, visible;  ///< in the model's domain; in the image
    Vector3 direction;
    Eigen::Vector2<Scalar> pixel;
    Eigen::Matrix<Scalar, 2, 3> slides;  ///< ∂pixel/∂direction
  };

  [[nodiscard]] Sample sample(const Scalar& alpha, const Scalar& beta) const {
    Sample s{alpha, beta, false, false, alpha * e0_ + beta * e1_, {}, {}};
    if (const auto p = camera_.model().template linearize<Wrt::point>(s.direction)) {
      s.valid = true;
      s.pixel = p->pixel;
      s.slides = p->point_jacobian;
      s.visible = camera_.sees(p->pixel);
    }
    return s;
  }
  [[nodiscard]] Sample between(const Sample& a, const Sample& b, const Scalar& x) const {
    return sample(a.alpha + x * (b.alpha - a.alpha), a.beta + x * (b.beta - a.beta));
  }

  void search(const Sample& a, const Sample& b, int splits) {
    const Scalar half = Scalar(1) / Scalar(2);
    if (a.valid && b.valid) {
      const Scalar bend = deviation(a, b);
      if (a.visible != b.visible)
        return bend < half || splits >= most_splits ? border(a, b) : split(a, b, half, splits);
      if (splits >= most_splits) return;
      if (a.visible) return bend > (std::min)(margin(a), margin(b)) ? split(a, b, half, splits) : void();
      const auto [from, to] = inside(a, b, bend);
      if (from <= to) split(a, b, bend < half ? Scalar((from + to) / Scalar(2)) : half, splits);
    } else if (a.visible || b.visible) {
      border(a, b);
    } else if (a.valid || b.valid) {
      if (splits < most_splits && !leaves_image(a.valid ? a : b, a.valid ? b : a)) split(a, b, half, splits);
    } else if (splits == 0) {
      split(a, b, half, splits);
    }
  }
  void split(const Sample& a, const Sample& b, const Scalar& x, int splits) {
    const Sample m = between(a, b, (std::min)((std::max)(x, Scalar(1) / Scalar(16)), Scalar(15) / Scalar(16)));
    search(a, m, splits + 1);
    search(m, b, splits + 1);
  }

  /// A bound of the distance between the image of the segment and the chord from a to b, pixels.
  [[nodiscard]] static Scalar deviation(const Sample& a, const Sample& b) {
    using std::abs;
    const Eigen::Vector2<Scalar> chord = b.pixel - a.pixel;
    const Scalar length = chord.norm();
    const Vector3 turn = b.direction - a.direction;
    const Eigen::Vector2<Scalar> at_a = a.slides * turn, at_b = b.slides * turn;
    if (!(length > Scalar(0))) return at_a.norm() + at_b.norm();
    const auto across = [&](const Eigen::Vector2<Scalar>& v) {
      return Scalar(abs(v.x() * chord.y() - v.y() * chord.x())) / length;
    };
    return (across(at_a) + across(at_b)) * Scalar(3) / Scalar(10);
  }
  /// The distance of a pixel in the image from its border.
  [[nodiscard]] Scalar margin(const Sample& s) const {
    const auto w = static_cast<Scalar>(camera_.size().width), h = static_cast<Scalar>(camera_.size().height);
    return (std::min)({s.pixel.x(), Scalar(w - s.pixel.x()), s.pixel.y(), Scalar(h - s.pixel.y())});
  }
  /// The part of the chord, from 0 at a to 1 at b, that is at most `bend` outside the image; empty if its first number is
  /// larger than its second. Liang and Barsky, "A new concept and method for line clipping", ACM TOG 1984.
  [[nodiscard]] std::array<Scalar, 2> inside(const Sample& a, const Sample& b, const Scalar& bend) const {
    std::array<Scalar, 2> part{Scalar(0), Scalar(1)};
    const int sizes[2] = {camera_.size().width, camera_.size().height};
    for (int i = 0; i < 2; ++i) {
      const Scalar rise = b.pixel[i] - a.pixel[i], low = -bend - a.pixel[i];
      const Scalar high = static_cast<Scalar>(sizes[i]) + bend - a.pixel[i];
      if (rise == Scalar(0)) {
        if (low > Scalar(0) || high < Scalar(0)) return {Scalar(1), Scalar(0)};
        continue;
      }
      part[0] = (std::max)(part[0], Scalar((rise > Scalar(0) ? low : high) / rise));
      part[1] = (std::min)(part[1], Scalar((rise > Scalar(0) ? high : low) / rise));
    }
    return part;
  }
  /// The pixel of `from` is outside the image and moves away from it towards `to`.
  [[nodiscard]] bool leaves_image(const Sample& from, const Sample& to) const {
    const Eigen::Vector2<Scalar> slide = from.slides * (to.direction - from.direction);
    const int sizes[2] = {camera_.size().width, camera_.size().height};
    for (int i = 0; i < 2; ++i) {
      if (from.pixel[i] < Scalar(0) && slide[i] < Scalar(0)) return true;
      if (from.pixel[i] >= static_cast<Scalar>(sizes[i]) && slide[i] > Scalar(0)) return true;
    }
    return false;
  }

  /// One of a and b is visible: notes the last visible point between them.
  void border(const Sample& a, const Sample& b) {
    Sample seen = a.visible ? a : b, hidden = a.visible ? b : a;
    for (int i = 0; i < 2 * std::numeric_limits<Scalar>::digits; ++i) {
      const Sample m = between(seen, hidden, Scalar(1) / Scalar(2));
      const bool last =
          (m.alpha == seen.alpha && m.beta == seen.beta) || (m.alpha == hidden.alpha && m.beta == hidden.beta);
      (m.visible ? seen : hidden) = m;
      if (last) break;
    }
    cross(seen);
  }
  /// The segment appears or disappears at s.
  void cross(const Sample& s) {
    const Scalar from_last = s.beta * norms_[0], share = from_last / (s.alpha * norms_[1] + from_last);
    auto& end = open_ ? part_.last : part_.first;
    end = {s.pixel, share};
    if (open_) parts_.push_back(part_);
    open_ = !open_;
  }

  const Camera& camera_;
  Scalar norms_[2];
  Vector3 e0_, e1_;
  Part part_;
  bool open_ = false;
  Parts parts_;
};

}  // namespace splinertia::detail

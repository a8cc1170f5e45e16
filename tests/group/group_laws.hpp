// SPDX-License-Identifier: MIT
/// What holds for every Lie group, checked over a ladder of angles: 0, tiny, small, ordinary, near π and π itself.
///
/// The laws are written once, on tangents and coordinates as vectors of long double; AnyGroup<G> lends them the group.
/// Tolerances are in units of eps of the group's scalar: each of exp, log, a product or an action of Ad rounds a unit
/// quaternion or a vector of size L by up to 2 eps (group/detail/rotation.hpp), and a law is a chain of two to six of those,
/// on elements of size 1 + L. Nothing is drawn from std::random_device or a std:: distribution: every run is the same.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <random>
#include <splinertia/detail/pi.hpp>
#include <splinertia/group/lie_group.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/catch.hpp"

namespace laws {

using namespace splinertia::detail;

using Real = long double;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

inline constexpr Real pi = splinertia::detail::pi_of<Real>();

/// Where a tangent's rotations and translations are: {begin, size} of each.
struct Parts {
  std::vector<std::pair<int, int>> rotations, translations;
};

/// Specialised beside each group that is tested:
///   static Parts parts()
///   static Vector numbers(const G& x)     coordinates that are equal if and only if the elements are
template <typename G>
struct Describe;

template <typename Scalar, int N>
struct Describe<Eigen::Matrix<Scalar, N, 1>> {
  static Parts parts() { return {{}, {{0, N}}}; }
  static Vector numbers(const Eigen::Matrix<Scalar, N, 1>& x) { return x.template cast<Real>(); }
};

/// A group whose type is forgotten.
class Group {
 public:
  using Element = std::shared_ptr<const void>;

  virtual ~Group() = default;
  [[nodiscard]] virtual Vector numbers(const Element& x) const = 0;
  [[nodiscard]] virtual Vector rounded(const Vector& tau) const = 0;  // to the group's scalar
  [[nodiscard]] virtual Element identity() const = 0;
  [[nodiscard]] virtual Element compose(const Element& x, const Element& y) const = 0;
  [[nodiscard]] virtual Element inverse(const Element& x) const = 0;
  [[nodiscard]] virtual Element exp(const Vector& tau) const = 0;
  [[nodiscard]] virtual Vector log(const Element& x) const = 0;
  [[nodiscard]] virtual Vector increment(const Element& x, const Element& y) const = 0;
  [[nodiscard]] virtual Vector adjoint(const Element& x, const Vector& tau) const = 0;
  [[nodiscard]] virtual Vector adjoint_inverse(const Element& x, const Vector& tau) const = 0;
  [[nodiscard]] virtual Vector bracket(const Vector& a, const Vector& b) const = 0;
  [[nodiscard]] virtual Matrix left_jacobian(const Vector& tau) const = 0;
  [[nodiscard]] virtual Matrix right_jacobian(const Vector& tau) const = 0;
  [[nodiscard]] virtual Matrix left_jacobian_inverse(const Vector& tau) const = 0;
  [[nodiscard]] virtual Matrix right_jacobian_inverse(const Vector& tau) const = 0;

  int dof = 0;
  Real eps = 0, smallest = 0;
  bool commutative = false, has_jacobians = false, has_increment = false;
  Parts parts;
};

template <typename G>
class AnyGroup final : public Group {
  using T = splinertia::GroupTraits<G>;
  using Scalar = splinertia::ScalarOf<G>;
  using Tangent = splinertia::Tangent<G>;

 public:
  AnyGroup() {
    dof = T::Dof;
    eps = std::numeric_limits<Scalar>::epsilon();
    smallest = std::numeric_limits<Scalar>::denorm_min();
    commutative = splinertia::detail::is_commutative<G>;
    has_jacobians = splinertia::LieGroupWithJacobians<G>;
    has_increment = requires(const G& x) { T::increment(x, x); };
    parts = Describe<G>::parts();
  }
  Vector numbers(const Element& x) const override { return Describe<G>::numbers(of(x)); }
  Vector rounded(const Vector& tau) const override { return wide(narrow(tau)); }
  Element identity() const override { return make(T::identity()); }
  Element compose(const Element& x, const Element& y) const override { return make(T::compose(of(x), of(y))); }
  Element inverse(const Element& x) const override { return make(T::inverse(of(x))); }
  Element exp(const Vector& tau) const override { return make(T::exp(narrow(tau))); }
  Vector log(const Element& x) const override { return wide(T::log(of(x))); }
  Vector increment(const Element& x, const Element& y) const override {
    return wide(splinertia::increment<G>(of(x), of(y)));
  }
  Vector adjoint(const Element& x, const Vector& tau) const override { return wide(T::adjoint(of(x), narrow(tau))); }
  Vector adjoint_inverse(const Element& x, const Vector& tau) const override {
    return wide(splinertia::adjoint_inverse<G>(of(x), narrow(tau)));
  }
  Vector bracket(const Vector& a, const Vector& b) const override { return wide(T::bracket(narrow(a), narrow(b))); }
  Matrix left_jacobian(const Vector& tau) const override {
    if constexpr (splinertia::LieGroupWithJacobians<G>) return wide(splinertia::left_jacobian<G>(narrow(tau)));
    throw std::logic_error("no Jacobians");
  }
  Matrix right_jacobian(const Vector& tau) const override {
    if constexpr (splinertia::LieGroupWithJacobians<G>) return wide(splinertia::right_jacobian<G>(narrow(tau)));
    throw std::logic_error("no Jacobians");
  }
  Matrix left_jacobian_inverse(const Vector& tau) const override {
    if constexpr (splinertia::LieGroupWithJacobians<G>) return wide(splinertia::left_jacobian_inverse<G>(narrow(tau)));
    throw std::logic_error("no Jacobians");
  }
  Matrix right_jacobian_inverse(const Vector& tau) const override {
    if constexpr (splinertia::LieGroupWithJacobians<G>) return wide(splinertia::right_jacobian_inverse<G>(narrow(tau)));
    throw std::logic_error("no Jacobians");
  }

 private:
  static Element make(const G& x) { return std::make_shared<const G>(x); }
  static const G& of(const Element& x) { return *static_cast<const G*>(x.get()); }
  static Tangent narrow(const Vector& tau) { return tau.template cast<Scalar>(); }
  static auto wide(const auto& m) { return m.template cast<Real>().eval(); }
};

/// Raw draws of a fixed seed.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : engine_(seed) {}
  /// Uniform in [-1, 1).
  double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-52 - 1.0; }

 private:
  std::mt19937_64 engine_;
};

/// A tangent with every rotation by `angle` and every translation of length `length`, in random directions.
[[nodiscard]] inline Vector tangent(const Group& group, Draws& draw, Real angle, Real length) {
  Vector tau = Vector::Zero(group.dof);
  const auto fill = [&](const auto& ranges, Real size) {
    for (const auto& [begin, count] : ranges) {
      Vector direction(count);
      do {
        for (int i = 0; i < count; ++i) direction[i] = draw();
      } while (direction.norm() < 0.1L);
      tau.segment(begin, count) = size * direction.normalized();
    }
  };
  fill(group.parts.rotations, angle);
  fill(group.parts.translations, length);
  return group.rounded(tau);
}

[[nodiscard]] inline std::vector<Real> angles() {
  return {0,     1e-300L, 1e-160L, 1e-30L,     1e-20L,     1e-12L,     1e-10L,      1e-8L,
          1e-7L, 1e-6L,   1e-5L,   1e-4L,      1e-3L,      0.01L,      0.1L,        0.5L,
          1,     2,       3,       pi - 1e-3L, pi - 1e-6L, pi - 1e-8L, pi - 1e-12L, pi};
}

/// The largest error in units of its tolerance, and where it was.
class Worst {
 public:
  void add(Real error, Real tolerance, Real angle, Real length) {
    if (std::isnan(ratio_) || error <= ratio_ * tolerance) return;
    ratio_ = tolerance > 0 ? error / tolerance : std::numeric_limits<Real>::infinity();
    std::ostringstream text;
    text << "error " << error << " is " << ratio_ << " of its tolerance at angle " << angle << ", length " << length;
    where_ = text.str();
  }
  void require(const char* law) const {
    INFO(law << ": " << where_);
    CHECK(ratio_ <= 1);
  }

 private:
  Real ratio_ = 0;
  std::string where_;
};

/// The largest component; NaN where there is one.
template <typename Derived>
[[nodiscard]] Real largest(const Eigen::MatrixBase<Derived>& m) {
  Real result = 0;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j < m.cols(); ++j) {
      const Real e = std::abs(static_cast<Real>(m(i, j)));
      if (!(e <= result)) result = e;
    }
  }
  return result;
}

[[nodiscard]] inline Real distance(const Group& group, const Group::Element& x, const Group::Element& y) {
  return largest(group.numbers(x) - group.numbers(y));
}

/// Calls f(τ, angle, length) for every angle and some lengths, three directions each.
inline void for_tangents(const Group& group, const auto& f) {
  Draws draw(20240607);
  for (const Real angle : angles()) {
    for (const Real length : {0.0L, 1e-6L, 1.0L, 1e3L}) {
      for (int i = 0; i < 3; ++i) f(tangent(group, draw, angle, length), angle, length);
    }
  }
}

/// Some ordinary element.
[[nodiscard]] inline Group::Element element(const Group& group, Draws& draw) {
  return group.exp(tangent(group, draw, 2, 3));
}

/// log(exp(τ)) = τ, each part relative to its own size: 4 eps for a rotation, 8 for a translation (J_l and its inverse,
/// 3 eps each, and their product). At π the principal log may be that of the opposite axis: the next law judges that.
inline void log_of_exp(const Group& group) {
  Worst worst;
  for_tangents(group, [&](const Vector& tau, Real angle, Real length) {
    if (!group.parts.rotations.empty() && angle > pi - 4 * group.eps * angle) return;
    const Vector error = group.log(group.exp(tau)) - tau;
    for (const auto& [begin, size] : group.parts.rotations) {
      worst.add(largest(error.segment(begin, size)), 4 * group.eps * angle + 4 * group.smallest, angle, length);
    }
    for (const auto& [begin, size] : group.parts.translations) {
      worst.add(largest(error.segment(begin, size)), 8 * group.eps * length, angle, length);
    }
  });
  worst.require("log(exp(tau)) = tau");
}

/// exp(log(x)) = x, at π, too.
inline void exp_of_log(const Group& group) {
  Worst worst;
  for_tangents(group, [&](const Vector& tau, Real angle, Real length) {
    const auto x = group.exp(tau);
    worst.add(distance(group, group.exp(group.log(x)), x), 16 * group.eps * (1 + length), angle, length);
  });
  worst.require("exp(log(x)) = x");
}

inline void axioms(const Group& group) {
  Worst identity, inverse, associative, commutes;
  Draws draw(7);
  for_tangents(group, [&](const Vector& tau, Real angle, Real length) {
    const auto x = group.exp(tau);
    identity.add(std::max(distance(group, group.compose(x, group.identity()), x),
                          distance(group, group.compose(group.identity(), x), x)),
                 4 * group.eps * (1 + length), angle, length);
    inverse.add(std::max(distance(group, group.compose(x, group.inverse(x)), group.identity()),
                         distance(group, group.compose(group.inverse(x), x), group.identity())),
                16 * group.eps * (1 + length), angle, length);
    const auto y = element(group, draw), z = element(group, draw);
    associative.add(distance(group, group.compose(group.compose(x, y), z), group.compose(x, group.compose(y, z))),
                    32 * group.eps * (10 + length), angle, length);
    if (group.commutative) {
      commutes.add(distance(group, group.compose(x, y), group.compose(y, x)), 8 * group.eps * (3 + length), angle,
                   length);
    }
  });
  identity.require("x e = e x = x");
  inverse.require("x inverse(x) = e");
  associative.require("(x y) z = x (y z)");
  commutes.require("x y = y x");
}

/// increment(x, y) = log(x⁻¹ y); 0, not nearly 0, for y = x; and relative accuracy is tested where exact truth is
/// known.
inline void increments(const Group& group) {
  Worst plain, equal, leads;
  Draws draw(11);
  for_tangents(group, [&](const Vector& tau, Real angle, Real length) {
    const auto x = element(group, draw);
    const auto y = group.compose(x, group.exp(tau));
    const Vector d = group.increment(x, y);
    const Real size = 32 * group.eps * (10 + length);
    if (angle < 3.1L) plain.add(largest(d - group.log(group.compose(group.inverse(x), y))), size, angle, length);
    leads.add(distance(group, group.compose(x, group.exp(d)), y), size, angle, length);
    // Without the difference form x⁻¹ x is the identity only to rounding.
    equal.add(largest(group.increment(y, y)), group.has_increment ? 0 : size, angle, length);
  });
  plain.require("increment(x, y) = log(inverse(x) y)");
  leads.require("x exp(increment(x, y)) = y");
  equal.require("increment(x, x) = 0");
}

/// x exp(τ) x⁻¹ = exp(Ad_x τ), and Ad_{x⁻¹} undoes Ad_x.
inline void adjoints(const Group& group) {
  Worst identity, inverse;
  Draws draw(13);
  for_tangents(group, [&](const Vector& tau, Real angle, Real length) {
    const auto x = element(group, draw);
    const Vector Ad = group.adjoint(x, tau);
    // exp's argument is of size 3 angle + length here, for |translation of x| = 3 or less.
    identity.add(distance(group, group.compose(group.compose(x, group.exp(tau)), group.inverse(x)), group.exp(Ad)),
                 32 * group.eps * (20 + length), angle, length);
    inverse.add(largest(group.adjoint_inverse(x, Ad) - tau), 32 * group.eps * (4 * angle + length), angle, length);
  });
  identity.require("x exp(tau) inverse(x) = exp(Ad tau)");
  inverse.require("Ad of the inverse undoes Ad");
}

/// [a, b] = d/dh Ad_exp(h a) b by central differences (steps of ∛eps err by eps^(2/3)); antisymmetry; Jacobi's
/// identity.
inline void brackets(const Group& group) {
  Worst derivative, antisymmetric, jacobi;
  Draws draw(17);
  const Real h = std::cbrt(group.eps);
  for (int i = 0; i < 50; ++i) {
    const Vector a = tangent(group, draw, 1, 2), b = tangent(group, draw, 1, 2), c = tangent(group, draw, 1, 2);
    const Vector forward = group.adjoint(group.exp(h * a), b), backward = group.adjoint(group.exp(-h * a), b);
    derivative.add(largest((forward - backward) / (2 * h) - group.bracket(a, b)), 20 * h * h, 1, 2);
    antisymmetric.add(largest(group.bracket(a, b) + group.bracket(b, a)), 8 * group.eps, 1, 2);
    jacobi.add(largest(group.bracket(a, group.bracket(b, c)) + group.bracket(b, group.bracket(c, a)) +
                       group.bracket(c, group.bracket(a, b))),
               64 * group.eps, 1, 2);
  }
  derivative.require("bracket = derivative of Ad");
  antisymmetric.require("[a, b] = -[b, a]");
  jacobi.require("Jacobi");
}

/// Columns of J_l and J_r against central differences of exp (steps of ∛eps err by eps^(2/3) times third derivatives).
inline void jacobians_against_differences(const Group& group) {
  Worst left, right;
  const Real h = std::cbrt(group.eps);
  for_tangents(group, [&](const Vector& tau, Real angle, Real length) {
    if (length > 1) return;  // a step h there is lost in the rounding of the translation
    const auto x = group.exp(tau);
    const auto Jl = group.left_jacobian(tau), Jr = group.right_jacobian(tau);
    for (int i = 0; i < group.dof; ++i) {
      const Vector step = h * Vector::Unit(group.dof, i);
      const auto forward = group.exp(tau + step), backward = group.exp(tau - step);
      right.add(largest((group.increment(x, forward) - group.increment(x, backward)) / (2 * h) - Jr.col(i)), 20 * h * h,
                angle, length);
      const auto from_left = [&](const Group::Element& y) { return group.log(group.compose(y, group.inverse(x))); };
      left.add(largest((from_left(forward) - from_left(backward)) / (2 * h) - Jl.col(i)), 20 * h * h, angle, length);
    }
  });
  left.require("J_l against central differences");
  right.require("J_r against central differences");
}

/// J J⁻¹ = I, and J_l = Ad_exp(τ) J_r. Blocks beside the diagonal are of size `length`, twice so in products.
inline void jacobian_identities(const Group& group) {
  Worst left, right, both;
  for_tangents(group, [&](const Vector& tau, Real angle, Real length) {
    const Matrix Jl = group.left_jacobian(tau), Jr = group.right_jacobian(tau);
    const Real tolerance = 16 * group.eps * (1 + 2 * length);
    left.add(largest(Jl * group.left_jacobian_inverse(tau) - Matrix::Identity(group.dof, group.dof)), tolerance, angle,
             length);
    right.add(largest(group.right_jacobian_inverse(tau) * Jr - Matrix::Identity(group.dof, group.dof)), tolerance,
              angle, length);
    const auto x = group.exp(tau);
    for (int i = 0; i < group.dof; ++i) {
      both.add(largest(group.adjoint(x, Jr.col(i)) - Jl.col(i)), tolerance, angle, length);
    }
  });
  left.require("J_l inverse(J_l) = I");
  right.require("inverse(J_r) J_r = I");
  both.require("J_l = Ad J_r");
}

/// All of the above, the last two for a group that has Jacobians.
template <splinertia::LieGroup G>
void hold_for() {
  const AnyGroup<G> group;
  log_of_exp(group);
  exp_of_log(group);
  axioms(group);
  increments(group);
  adjoints(group);
  brackets(group);
  if (!group.has_jacobians) return;
  jacobians_against_differences(group);
  jacobian_identities(group);
}

}  // namespace laws

// SPDX-License-Identifier: MIT
/// What every camera model must do. A model is given as a template Model<Scalar>, with cases of its parameters.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <random>
#include <splinertia/camera/camera_model.hpp>
#include <splinertia/detail/pi.hpp>
#include <splinertia/detail/simd_pack.hpp>

#include "support/catch.hpp"

namespace splinertia::testing {

using ModelCase = std::initializer_list<double>;

template <typename Model>
[[nodiscard]] Model model_of(const ModelCase& parameters) {
  REQUIRE(parameters.size() == Model::parameter_count);
  typename Model::Parameters p;
  std::copy(parameters.begin(), parameters.end(), p.data());
  return Model::from_parameters(p);
}

/// Uniform numbers with a fixed seed.
class Uniform {
 public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}
  template <typename Scalar>
  [[nodiscard]] Scalar operator()(Scalar low, Scalar high) {
    return low + (high - low) * static_cast<Scalar>(static_cast<long double>(engine_() >> 11) * 0x1p-53L);
  }

 private:
  std::mt19937_64 engine_;
};

template <typename Model>
[[nodiscard]] auto largest_angle(const Model& model) {
  if constexpr (requires { model.largest_angle(); }) {
    return model.largest_angle();
  } else {
    return detail::pi_of<typename Model::Scalar>();
  }
}

template <typename Scalar>
[[nodiscard]] Eigen::Vector3<Scalar> at_angle(const Scalar& theta, const Scalar& azimuth) {
  return {std::sin(theta) * std::cos(azimuth), std::sin(theta) * std::sin(azimuth), std::cos(theta)};
}

/// A direction in the domain; `share` of the angle up to which the domain extends is used.
template <typename Model>
[[nodiscard]] Eigen::Vector3<typename Model::Scalar> random_direction(const Model& model, Uniform& uniform,
                                                                      double share = 0.99) {
  using Scalar = typename Model::Scalar;
  const Scalar theta = uniform(Scalar(0), static_cast<Scalar>(share) * largest_angle(model));
  return at_angle<Scalar>(theta, uniform(Scalar(-3), Scalar(3)));
}

/// Pixels per unit of the image plane, or per radian.
template <typename Model>
[[nodiscard]] auto pixel_unit(const Model& model) {
  if constexpr (requires { model.fx(); }) {
    return (std::max)(model.fx(), model.fy());
  } else {
    return model.width();
  }
}

/// The radius on the image plane at which the domain ends, or `most`.
template <typename Model>
[[nodiscard]] typename Model::Scalar image_radius(const Model& model, double most) {
  using Scalar = typename Model::Scalar;
  const Scalar end = largest_angle(model) * (1 - std::sqrt(std::numeric_limits<Scalar>::epsilon()));
  for (int i = 1;; ++i) {
    const auto pixel = model.project(at_angle<Scalar>(end * static_cast<Scalar>(i) / 100, 0));
    REQUIRE(pixel);
    const Scalar radius = (pixel->x() - model.cx()) / model.fx();
    if (i == 100 || radius > static_cast<Scalar>(most)) return (std::min)(static_cast<Scalar>(most), radius);
  }
}

template <typename Model>
[[nodiscard]] Eigen::Vector2<typename Model::Scalar> random_pixel(const Model& model, double radius, Uniform& uniform) {
  using Scalar = typename Model::Scalar;
  if constexpr (requires { model.fx(); }) {
    const Scalar r = static_cast<Scalar>(radius) * std::sqrt(uniform(Scalar(0), Scalar(1)));
    const Scalar azimuth = uniform(Scalar(-3.2), Scalar(3.2));
    return {model.cx() + model.fx() * (r * std::cos(azimuth)), model.cy() + model.fy() * (r * std::sin(azimuth))};
  } else {
    return {uniform(Scalar(0), model.width()), uniform(Scalar(0), model.height())};
  }
}

/// project(unproject(pixel)) for random pixels of the whole image, or up to two focal lengths from its centre: further
/// out the rounding of the ray alone exceeds what is allowed. The border may be shifted by tangential distortion, so that
/// not quite all pixels there have a ray.
struct RoundTrip {
  double worst = 0;  ///< largest error in units of eps · max(focal length, pixel, pixels per radian of the ray)
  int without_ray = 0, lost = 0;
};
template <typename Model>
[[nodiscard]] RoundTrip round_trip(const Model& model, int count) {
  using Scalar = typename Model::Scalar;
  double radius = 1;
  if constexpr (requires { model.fx(); }) radius = static_cast<double>(image_radius(model, 2));
  Uniform uniform(1);
  RoundTrip result;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2<Scalar> pixel = random_pixel(model, radius, uniform);
    const auto ray = model.unproject(pixel);
    if (!ray) {
      ++result.without_ray;
      continue;
    }
    const auto back = model.template linearize<Wrt::point>(*ray);
    if (!back) {
      ++result.lost;
      continue;
    }
    const Scalar per_radian = back->point_jacobian.cwiseAbs().maxCoeff();
    const Scalar unit = (std::max)({pixel_unit(model), pixel.cwiseAbs().maxCoeff(), per_radian});
    const Scalar error =
        (back->pixel - pixel).template lpNorm<Eigen::Infinity>() / (std::numeric_limits<Scalar>::epsilon() * unit);
    if (!(static_cast<double>(error) <= result.worst)) result.worst = static_cast<double>(error);
  }
  return result;
}

/// The derivative of f at x along one component, from six values around it. For long double the error is about 1e-15.
template <typename Vector>
[[nodiscard]] auto difference(const auto& f, const Vector& x, Eigen::Index i, long double h) {
  const auto at = [&](int k) {
    Vector moved = x;
    moved[i] += k * h;
    return f(moved);
  };
  return ((45 * (at(1) - at(-1)) - 9 * (at(2) - at(-2)) + (at(3) - at(-3))) / (60 * h)).eval();
}

/// Largest |a − b| as a share of the largest |b|, or of `least`.
[[nodiscard]] double relative(const auto& a, const auto& b, long double least) {
  const auto wide = a.template cast<long double>().eval();
  return static_cast<double>((wide - b).cwiseAbs().maxCoeff() / (std::max)(least, b.cwiseAbs().maxCoeff()));
}

/// Jacobians against differences of the long double model.
template <typename Model, typename Wide>
void check_jacobians(const Model& model, const Wide& wide, double tolerance) {
  using Scalar = typename Model::Scalar;
  using L = long double;
  Uniform uniform(2);
  const auto focal = static_cast<L>(pixel_unit(model));
  double by_point = 0, by_parameters = 0, by_pixel = 0;
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector3<Scalar> point = random_direction(model, uniform, 0.6) * Scalar(2);
    const auto p = model.template linearize<Wrt::point | Wrt::parameters>(point);
    REQUIRE(p);
    const Eigen::Vector3<L> at = point.template cast<L>();
    Eigen::Matrix<L, 2, 3> P;
    for (int c = 0; c < 3; ++c) {
      P.col(c) = difference([&](const auto& x) { return wide.project(x).value(); }, at, c, 0x1p-13L);
    }
    by_point = (std::max)(by_point, relative(p->point_jacobian, P, focal));
    const typename Wide::Parameters around = wide.parameters();
    const auto with = [&](const typename Wide::Parameters& v) { return Wide::from_parameters(v).project(at).value(); };
    for (int c = 0; c < Wide::parameter_count; ++c) {
      const L h = (std::max)(L(1), std::abs(around[c])) * 0x1p-13L;
      if ((around[c] < 4 * h && around[c] >= 0) || around[c] == 1) continue;  // may be a bound
      const auto column = difference(with, around, c, h);
      by_parameters = (std::max)(
          by_parameters, relative(p->parameter_jacobian.col(c), column, focal / (std::max)(L(1), std::abs(around[c]))));
    }
    const auto ray = model.linearize_ray(p->pixel);
    REQUIRE(ray);
    Eigen::Matrix<L, 3, 2> R;
    const Eigen::Vector2<L> pixel = p->pixel.template cast<L>();
    for (int c = 0; c < 2; ++c) {
      const auto f = [&](const auto& x) { return wide.unproject(x).value(); };
      R.col(c) = difference(f, pixel, c, focal * 0x1p-13L);
    }
    by_pixel = (std::max)(by_pixel, relative(ray->pixel_jacobian, R, 1 / focal));
    CHECK(relative(ray->direction, wide.unproject(pixel).value(), 1) <= tolerance);
  }
  CHECK(by_point <= tolerance);
  CHECK(by_parameters <= tolerance);
  CHECK(by_pixel <= tolerance);
}

/// A point can have any size, but neither NaN nor infinity.
template <typename Model>
void check_extremes(const Model& model) {
  using Scalar = typename Model::Scalar;
  using Limits = std::numeric_limits<Scalar>;
  Uniform uniform(3);
  for (int i = 0; i < 20; ++i) {
    const auto ray = random_direction(model, uniform);
    const auto one = model.template linearize<Wrt::parameters>(ray);
    REQUIRE(one);
    for (const int exponent : {Limits::max_exponent - 24, Limits::min_exponent + 24}) {
      const Eigen::Vector3<Scalar> point = ray.unaryExpr([&](Scalar x) { return std::ldexp(x, exponent); });
      const auto scaled = model.template linearize<Wrt::parameters>(point);
      REQUIRE(scaled);
      CHECK(scaled->pixel == one->pixel);
      CHECK(scaled->parameter_jacobian == one->parameter_jacobian);
    }
  }
  const Eigen::Vector3<Scalar> forward(Scalar(0.01), Scalar(0.02), Scalar(1));
  const Eigen::Vector2<Scalar> pixel = model.project(forward).value();
  for (const Scalar bad : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()}) {
    for (int c = 0; c < 3; ++c) {
      for (const Scalar rest : {Scalar(0), Scalar(1)}) {
        Eigen::Vector3<Scalar> point = forward * rest;
        point[c] = bad;
        CHECK_FALSE(model.project(point));
        CHECK_FALSE(model.template linearize<Wrt::point>(point));
      }
    }
    for (int c = 0; c < 2; ++c) {
      Eigen::Vector2<Scalar> no_pixel = pixel;
      no_pixel[c] = bad;
      CHECK_FALSE(model.unproject(no_pixel));
      CHECK_FALSE(model.linearize_ray(no_pixel));
    }
  }
  CHECK_FALSE(model.project(Eigen::Vector3<Scalar>::Zero()));
  for (const Scalar far : {Limits::max() / 2, Limits::max() / 65536, std::sqrt(Limits::max()) * 2, Limits::min()}) {
    const auto ray = model.linearize_ray({far, far});
    if (!ray) continue;
    CHECK(ray->direction.allFinite());
    CHECK(ray->pixel_jacobian.allFinite());
  }
}

/// One-to-one: the radius in the image grows with the angle from the axis, all the way to `end`.
template <typename Model>
void check_radius_grows(const Model& model, typename Model::Scalar end) {
  using Scalar = typename Model::Scalar;
  const Scalar step(1e-3F);
  Scalar last(-1);
  for (Scalar theta = 0; theta < end - step; theta += step) {
    const auto pixel = model.project(at_angle<Scalar>(theta, 0));
    REQUIRE(pixel);
    REQUIRE(pixel->x() > last);
    last = pixel->x();
  }
}

/// Each lane of a SIMD pack has the pixel, the Jacobians and the validity of the same point alone.
template <typename Model>
void check_lanes(const Model& model) {
  using Scalar = typename Model::Scalar;
  using Pack = detail::NativeSimdPack<Scalar>;
  constexpr auto size = static_cast<std::size_t>(Pack::size);
  constexpr Wrt wrt = Wrt::point | Wrt::parameters;
  const Scalar tolerance = 64 * std::numeric_limits<Scalar>::epsilon();
  const Scalar end = largest_angle(model), pi = detail::pi_of<Scalar>();
  Uniform uniform(4);
  for (int i = 0; i < 200; ++i) {
    Scalar x[size], y[size], z[size];
    for (std::size_t lane = 0; lane < size; ++lane) {
      const bool outside = lane % 4 == 0 && end * Scalar(1.05) < pi;
      const Scalar theta = outside ? uniform(end * Scalar(1.05), pi) : uniform(Scalar(0), end * Scalar(0.8));
      const Eigen::Vector3<Scalar> point = at_angle<Scalar>(theta, uniform(Scalar(-3), Scalar(3))) * Scalar(i);
      x[lane] = point.x();
      y[lane] = point.y();
      z[lane] = point.z();
    }
    if (i == 1) z[0] = std::numeric_limits<Scalar>::infinity();
    Projection<Pack, Model::parameter_count, wrt> pack;
    const auto valid = model.template project_lanes<wrt>(Pack::load(x), Pack::load(y), Pack::load(z), pack);
    for (std::size_t lane = 0; lane < size; ++lane) {
      const auto alone = model.template linearize<wrt>({x[lane], y[lane], z[lane]});
      CHECK(valid[static_cast<int>(lane)] == alone.has_value());
      if (!alone) continue;
      const auto compare = [&](const auto& of_pack, const auto& of_one, const Scalar& unit) {
        const Scalar size_of = (std::max)(of_one.cwiseAbs().maxCoeff(), unit);
        for (Eigen::Index j = 0; j < of_one.size(); ++j) {
          Scalar lanes[size];
          of_pack.data()[j].store(lanes);
          CHECK(std::abs(lanes[lane] - of_one.data()[j]) <= tolerance * size_of);
        }
      };
      compare(pack.pixel, alone->pixel, pixel_unit(model));
      compare(pack.point_jacobian, alone->point_jacobian, Scalar(0));
      compare(pack.parameter_jacobian, alone->parameter_jacobian, pixel_unit(model));
    }
  }
}

/// All of the above.
template <template <typename> class Model, typename Scalar>
void check_model(std::initializer_list<ModelCase> cases) {
  using M = Model<Scalar>;
  static_assert(CameraModel<M>);
  static_assert(std::is_same_v<typename M::Scalar, Scalar>);
  for (const ModelCase& parameters : cases) {
    const M model = model_of<M>(parameters);
    INFO(M::name << " " << model.parameters().transpose());
    CHECK(M::from_parameters(model.parameters()).parameters() == model.parameters());
    const RoundTrip trip = round_trip(model, 100000 / static_cast<int>(cases.size()));
    CHECK(trip.worst <= 4);
    CHECK(trip.lost == 0);
    CHECK(trip.without_ray <= 1000);
    const double eps = static_cast<double>(std::numeric_limits<Scalar>::epsilon());
    check_jacobians(model, model_of<Model<long double>>(parameters), 200 * (std::max)(eps, 1e-16));
    check_extremes(model);
    if constexpr (!std::same_as<Scalar, long double>) check_lanes(model);
  }
}

}  // namespace splinertia::testing

// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstddef>
#include <span>
#include <splinertia/camera/camera_model.hpp>
#include <splinertia/detail/inline.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/detail/select.hpp>
#include <splinertia/detail/simd_pack.hpp>
#include <stdexcept>
#include <type_traits>
#include <utility>

namespace splinertia {

namespace detail {

/// Coordinate `Row` of as many points as a pack has lanes.
template <typename Pack, int Row, typename Scalar>
[[nodiscard]] SPLINERTIA_ALWAYS_INLINE inline Pack gather(const Eigen::Vector3<Scalar>* points) {
  Pack pack;
  const auto fill = [&]<std::size_t... Lane>(int vector, std::index_sequence<Lane...>) {
    const Eigen::Vector3<Scalar>* first = points + vector * Pack::width;
    pack.vector[vector] = typename Pack::Vector{first[Lane][Row]...};
  };
  for (int i = 0; i < Pack::vectors; ++i) fill(i, std::make_index_sequence<static_cast<std::size_t>(Pack::width)>{});
  return pack;
}

/// A model of this library over float or double; one of the user's need not know SIMD packs.
template <typename M, typename Pack>
concept ProjectsPacks =
    (std::same_as<typename M::Scalar, float> || std::same_as<typename M::Scalar, double>) &&
    requires(const M& model, const Pack& x, Projection<Pack, M::parameter_count, Wrt::nothing>& projection) {
      model.template project_lanes<Wrt::nothing, Pack>(x, x, x, projection);
    };

}  // namespace detail

/// Projects many points, at once as many as a SIMD instruction holds. If inside[i], pixels[i] is the image of points[i].
/// Otherwise the point is outside the domain of the model, and pixels[i] is zero. Throws std::invalid_argument unless the
/// three spans have the same size.
template <CameraModel M>
void project(const M& model, std::type_identity_t<std::span<const Eigen::Vector3<typename M::Scalar>>> points,
             std::type_identity_t<std::span<Eigen::Vector2<typename M::Scalar>>> pixels,
             std::type_identity_t<std::span<bool>> inside) {
  using Scalar = typename M::Scalar;
  if (pixels.size() != points.size() || inside.size() != points.size()) {
    detail::refuse<std::invalid_argument>("project: ", points.size(), " points, ", pixels.size(), " pixels, ",
                                          inside.size(), " flags, expected as many of each");
  }
  std::size_t i = 0;
  using Pack = detail::NativeSimdPack<Scalar>;
  if constexpr (detail::ProjectsPacks<M, Pack>) {
    constexpr auto lanes = static_cast<std::size_t>(Pack::size), width = static_cast<std::size_t>(Pack::width);
    for (; i + lanes <= points.size(); i += lanes) {
      const Eigen::Vector3<Scalar>* p = &points[i];
      Projection<Pack, M::parameter_count, Wrt::nothing> projected;
      const auto valid = model.template project_lanes<Wrt::nothing, Pack>(
          detail::gather<Pack, 0, Scalar>(p), detail::gather<Pack, 1, Scalar>(p), detail::gather<Pack, 2, Scalar>(p),
          projected);
      const Pack u = detail::select<Pack>(valid, projected.pixel.x(), Pack(Scalar(0)));
      const Pack v = detail::select<Pack>(valid, projected.pixel.y(), Pack(Scalar(0)));
      [&]<std::size_t... Lane>(std::index_sequence<Lane...>) {
        ((pixels[i + Lane] = {u.vector[Lane / width][Lane % width], v.vector[Lane / width][Lane % width]}), ...);
        ((inside[i + Lane] = valid.vector[Lane / width][Lane % width] != 0), ...);
      }(std::make_index_sequence<lanes>{});
    }
  }
  for (; i < points.size(); ++i) {
    const auto pixel = model.project(points[i]);
    inside[i] = pixel.has_value();
    pixels[i] = pixel.value_or(Eigen::Vector2<Scalar>::Zero());
  }
}

}  // namespace splinertia

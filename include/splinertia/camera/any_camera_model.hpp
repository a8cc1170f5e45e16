// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <splinertia/camera/detail/kalibr_layout.hpp>
#include <splinertia/camera/double_sphere.hpp>
#include <splinertia/camera/equirectangular.hpp>
#include <splinertia/camera/extended_unified.hpp>
#include <splinertia/camera/field_of_view.hpp>
#include <splinertia/camera/kalibr_camera.hpp>
#include <splinertia/camera/pinhole.hpp>
#include <splinertia/camera/unified.hpp>
#include <splinertia/detail/refuse.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace splinertia {

/// A camera model that is known only at run time: one of a file.
using AnyCameraModel =
    std::variant<Pinhole<NoDistortion<double>>, Pinhole<RadialTangential<double>>, Pinhole<Rational<double>>,
                 Pinhole<Equidistant<double>>, FieldOfView<double>, Unified<NoDistortion<double>>,
                 Unified<RadialTangential<double>>, Unified<Rational<double>>, DoubleSphere<double>,
                 ExtendedUnified<double>, Equirectangular<double>>;

/// The model that an entry names:
///   std::visit([](const auto& model) { … model.project(point) … }, any_camera_model(entry));
/// Throws std::invalid_argument for unknown names, and as from_kalibr() does.
[[nodiscard]] inline AnyCameraModel any_camera_model(const KalibrCamera& camera) {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    std::optional<AnyCameraModel> found;
    std::string known;
    const auto visit = [&]<typename Model>(const Model*) {
      constexpr auto layout = detail::kalibr_layout<Model>();
      known +=
          (known.empty() ? "" : ", ") + std::string(layout.camera_model) + ' ' + std::string(layout.distortion_model);
      if (names_model<Model>(camera)) found.emplace(from_kalibr<Model>(camera));
    };
    (visit(static_cast<const std::variant_alternative_t<I, AnyCameraModel>*>(nullptr)), ...);
    if (!found) {
      detail::refuse<std::invalid_argument>("KalibrCamera: camera_model is ", camera.camera_model,
                                            ", distortion_model is ", camera.distortion_model, ", expected one of ",
                                            known);
    }
    return *found;
  }(std::make_index_sequence<std::variant_size_v<AnyCameraModel>>());
}

}  // namespace splinertia

// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>
#include <string_view>

namespace splinertia::detail {

/// Where a file of Kalibr has the parameters of a model.
struct KalibrLayout {
  std::string_view camera_model, distortion_model;
  int intrinsics;  ///< their number; coefficients of the distortion follow them in parameters()
  int behind;      ///< how many of them parameters() has behind cy, and the file before fx

  /// The place in parameters() of number i of the file's intrinsics.
  [[nodiscard]] constexpr int index(int i) const { return i < behind ? intrinsics - behind + i : i - behind; }
};

/// The number of coefficients of a distortion that a model's name ends in.
[[nodiscard]] constexpr int distortion_count(std::string_view distortion) {
  if (distortion == "radtan" || distortion == "equi") return 4;
  if (distortion == "radtan8") return 8;
  return distortion == "fov" ? 1 : 0;
}

/// The layout of a model by its name, as pinhole-radtan.
template <typename Model>
[[nodiscard]] constexpr KalibrLayout kalibr_layout() {
  const std::string_view name = std::string_view(Model::name) == "fov" ? "pinhole-fov" : Model::name;
  const auto dash = name.find('-');
  const std::string_view camera = name.substr(0, dash);
  const std::string_view distortion = dash == std::string_view::npos ? "none" : name.substr(dash + 1);
  const int intrinsics = Model::parameter_count - distortion_count(distortion);
  const bool own_are_behind = camera == "ds" || camera == "eucm";
  return {camera, distortion == "equi" ? "equidistant" : distortion, intrinsics, own_are_behind ? intrinsics - 4 : 0};
}

}  // namespace splinertia::detail

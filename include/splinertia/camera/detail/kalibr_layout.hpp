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

/// A distortion at the end of a model's name, its name in files, and the number of its coefficients.
struct KalibrDistortion {
  std::string_view name, in_files;
  int count;
};

/// The layout of a model by its name, as pinhole-radtan.
template <typename Model>
[[nodiscard]] constexpr KalibrLayout kalibr_layout() {
  constexpr KalibrDistortion distortions[] = {
      {"-radtan", "radtan", 4}, {"-radtan8", "radtan8", 8}, {"-equi", "equidistant", 4}, {"fov", "fov", 1}};
  constexpr std::string_view name = Model::name, projection = name.substr(0, name.find('-'));
  KalibrDistortion distortion{"-none", "none", 0};
  for (const KalibrDistortion& d : distortions) {
    if (name.ends_with(d.name)) distortion = d;
  }
  const int intrinsics = Model::parameter_count - distortion.count;
  for (const std::string_view own_first : {"ds", "eucm"}) {
    if (projection == own_first) return {own_first, distortion.in_files, intrinsics, intrinsics - 4};
  }
  for (const std::string_view known : {"pinhole", "omni"}) {
    if (projection == known) return {known, distortion.in_files, intrinsics, 0};
  }
  return {name == "fov" ? "pinhole" : name, distortion.in_files, intrinsics, 0};
}

}  // namespace splinertia::detail

// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <splinertia/camera/camera.hpp>
#include <tuple>
#include <utility>

namespace splinertia {

/// Several cameras on one body, of any types: Rig rig{left, right}. It is as large as its cameras.
template <typename... Cameras>
class Rig {
 public:
  constexpr explicit Rig(Cameras... cameras) : cameras_(std::move(cameras)...) {}

  [[nodiscard]] static constexpr std::size_t size() { return sizeof...(Cameras); }

  template <std::size_t Index>
  [[nodiscard]] constexpr const auto& get() const {
    return std::get<Index>(cameras_);
  }

  /// Calls f(camera) for each camera, in order; or f(camera, index) if f takes an index.
  constexpr void for_each(auto&& f) const {
    [&]<std::size_t... Index>(std::index_sequence<Index...>) {
      [[maybe_unused]] const auto call = [&](const auto& camera, std::size_t index) {
        if constexpr (requires { f(camera, index); }) {
          f(camera, index);
        } else {
          f(camera);
        }
      };
      (call(std::get<Index>(cameras_), Index), ...);
    }(std::index_sequence_for<Cameras...>{});
  }

 private:
  [[no_unique_address]] std::tuple<Cameras...> cameras_;
};

}  // namespace splinertia

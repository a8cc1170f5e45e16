// SPDX-License-Identifier: MIT
#include <splinertia/camera/detail/model_name.hpp>
#include <string_view>

#include "support/catch.hpp"

namespace {

struct Named {
  static constexpr const char* name = "lens";
};

}  // namespace

TEST_CASE("a prefix and the name of a distortion") {
  constexpr const char* name = splinertia::detail::model_name<"camera-", Named>.data();
  static_assert(name == std::string_view("camera-lens"));
  CHECK(std::string_view(name).size() == 11);
}

// SPDX-License-Identifier: MIT
#include <splinertia/detail/refuse.hpp>
#include <stdexcept>
#include <string>

#include "support/catch.hpp"

using splinertia::detail::refuse;

TEST_CASE("refuse throws the error that is asked for, with the parts as its text") {
  try {
    refuse<std::out_of_range>("integrate: sample ", 3, " is at ", 0.1, " s");
  } catch (const std::out_of_range& error) {
    CHECK(error.what() == std::string("integrate: sample 3 is at 0.1 s"));
  }
  CHECK_THROWS_AS(refuse<std::invalid_argument>("no poses"), std::invalid_argument);
}

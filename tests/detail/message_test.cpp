// SPDX-License-Identifier: MIT
#include <limits>
#include <splinertia/detail/message.hpp>

#include "support/catch.hpp"

using splinertia::detail::message;

TEST_CASE("Numbers are as short as tells them apart") {
  CHECK(message("a ", 0.1, ' ', 3, " b") == "a 0.1 3 b");
  CHECK(message(0.1 + 0.2) == "0.30000000000000004");
  CHECK(message(0.1F) == "0.1");
  CHECK(message(-1.5e300) == "-1.5e+300");
  CHECK(message(1234567.0) == "1234567");
}

TEST_CASE("What is not finite is said, too") {
  CHECK(message(std::numeric_limits<double>::quiet_NaN()) == "nan");
  CHECK(message(-std::numeric_limits<double>::infinity()) == "-inf");
}

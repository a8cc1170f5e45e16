// SPDX-License-Identifier: MIT
/// Catch2, version 2 (one header) or 3 (many): tests include this file and use what is in both.
#pragma once

#if __has_include(<catch2/catch_test_macros.hpp>)
#include <catch2/catch_approx.hpp>
#include <catch2/catch_template_test_macros.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators_all.hpp>
#include <catch2/matchers/catch_matchers_all.hpp>
#else
#include <catch2/catch.hpp>
#ifndef STATIC_CHECK  // version 2 has only the form that stops the test
#define STATIC_CHECK(...) STATIC_REQUIRE(__VA_ARGS__)
#define STATIC_CHECK_FALSE(...) STATIC_REQUIRE_FALSE(__VA_ARGS__)
#endif
#ifndef SKIP  // version 2 cannot skip: say so and leave the test case
#define SKIP(...)                     \
  do {                                \
    WARN("SKIPPED: " << __VA_ARGS__); \
    return;                           \
  } while (false)
#endif
#endif

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using Catch::Matchers::WithinULP;

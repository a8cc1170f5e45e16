// SPDX-License-Identifier: MIT
/// How the library reports errors: it throws. Without exceptions (-fno-exceptions) it calls SPLINERTIA_REFUSE.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <cstdlib>
#include <splinertia/detail/inline.hpp>
#include <stdexcept>

#ifdef __cpp_exceptions
#include <splinertia/detail/message.hpp>
#else
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdio>
#include <string_view>

#ifndef SPLINERTIA_REFUSE
/// Only without exceptions: handles the text of an error, a `const char*`. If it returns, the program is aborted.
/// Define it before the first header of the library, identically in all source files.
#define SPLINERTIA_REFUSE(text) (std::fprintf(stderr, "%s\n", text), std::abort())
#endif
#endif

namespace splinertia::detail {

#ifndef __cpp_exceptions

/// Appends one part of a message at text[used], cut off at the end of the buffer. Uses no stream and no heap.
template <typename Part>
void append_part(char* text, std::size_t size, std::size_t& used, const Part& part) {
  int wanted = 0;
  char* const begin = text + used;
  if constexpr (std::convertible_to<const Part&, std::string_view>) {
    const std::string_view view(part);
    wanted = std::snprintf(begin, size - used, "%.*s", static_cast<int>(view.size()), view.data());
  } else if constexpr (std::same_as<Part, char>) {
    wanted = std::snprintf(begin, size - used, "%c", part);
  } else if constexpr (std::signed_integral<Part>) {
    wanted = std::snprintf(begin, size - used, "%lld", static_cast<long long>(part));
  } else if constexpr (std::unsigned_integral<Part>) {
    wanted = std::snprintf(begin, size - used, "%llu", static_cast<unsigned long long>(part));
  } else if constexpr (std::floating_point<Part>) {
    wanted = std::snprintf(begin, size - used, "%.9Lg", static_cast<long double>(part));
  } else {
    wanted = std::snprintf(begin, size - used, "?");
  }
  used = (std::min)(used + static_cast<std::size_t>((std::max)(wanted, 0)), size - 1);
}

#endif

/// Throws an Error whose message is made of the parts. Without exceptions, passes the message to SPLINERTIA_REFUSE.
template <typename Error, typename... Parts>
[[noreturn]] SPLINERTIA_COLD void refuse(const Parts&... parts) {
#ifdef __cpp_exceptions
  throw Error(message(parts...));
#else
  char text[256] = "";
  std::size_t used = 0;
  (append_part(text, sizeof text, used, parts), ...);
  SPLINERTIA_REFUSE(text);
  std::abort();
#endif
}

}  // namespace splinertia::detail

// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdint>
#include <string>
#include <system_error>

/// Adds an option that takes whole numbers from 0 to 2^64 − 1 and rejects everything else. CLI11 alone reads -1, and
/// numbers that are too large, as the largest of them.
inline CLI::Option* add_whole_number_option(CLI::App& app, const std::string& name, std::uint64_t& value,
                                            const std::string& description) {
  const auto read = [&value, name](const std::string& text) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
      throw CLI::ValidationError(name, text + ", expected a whole number from 0 to 18446744073709551615");
    }
  };
  return app.add_option_function<std::string>(name, read, description)->default_str(std::to_string(value));
}

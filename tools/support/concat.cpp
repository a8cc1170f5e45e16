// SPDX-License-Identifier: MIT
#include "support/concat.hpp"

#include <cstdlib>
#include <limits>

#include "support/formatted.hpp"

std::string short_number(double value) {
  std::string text;
  for (int digits = 6; digits <= std::numeric_limits<double>::max_digits10; ++digits) {
    text = formatted("%.*g", digits, value);
    if (std::strtod(text.c_str(), nullptr) == value) break;
  }
  return text;
}

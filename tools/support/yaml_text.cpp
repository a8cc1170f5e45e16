// SPDX-License-Identifier: MIT
#include "support/yaml_text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "support/concat.hpp"

namespace {

bool in(unsigned value, unsigned lowest, unsigned highest) { return lowest <= value && value <= highest; }

/// The number of bytes of the UTF-8 character at the beginning, if YAML allows it in a line; else 0.
std::size_t printable_bytes(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80) return in(first, 0x20, 0x7E) ? 1 : 0;
  const std::size_t size = in(first, 0xC2, 0xDF) ? 2 : in(first, 0xE0, 0xEF) ? 3 : in(first, 0xF0, 0xF4) ? 4 : 0;
  if (size == 0) return 0;
  unsigned code = first & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if (!in(byte(i), 0x80, 0xBF)) return 0;
    code = code << 6U | (byte(i) & 0x3FU);
  }
  constexpr std::array<unsigned, 5> smallest{0, 0, 0x80, 0x800, 0x10000};  // code of this many bytes
  const bool valid = code >= smallest[size] && code <= 0x10FFFF && !in(code, 0xD800, 0xDFFF);
  const bool breaks_line = code == 0x2028 || code == 0x2029;
  return valid && !breaks_line && code >= 0xA0 && !in(code, 0xFFFE, 0xFFFF) && code != 0xFEFF ? size : 0;
}

std::string escape(char character) {
  constexpr std::string_view digits = "0123456789abcdef";
  switch (character) {
    case '\n':
      return "\\n";
    case '\r':
      return "\\r";
    case '\t':
      return "\\t";
    default: {
      const auto byte = static_cast<unsigned char>(character);
      return {'\\', 'x', digits[byte / 16U], digits[byte % 16U]};
    }
  }
}

std::string escaped(std::string_view text, bool quoted) {
  std::string result;
  while (!text.empty()) {
    const std::size_t bytes = printable_bytes(text);
    if (quoted && (text.front() == '"' || text.front() == '\\')) result += '\\';
    result += bytes > 0 ? std::string(text.substr(0, bytes)) : escape(text.front());
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return result;
}

bool in_topic_names(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '_' || c == '/';
}

}  // namespace

std::string escaped_line(std::string_view text) { return escaped(text, false); }

std::string yaml_string(std::string_view text) {
  const bool topic = !text.empty() && text.front() == '/' && std::all_of(text.begin(), text.end(), in_topic_names);
  return topic ? std::string(text) : '"' + escaped(text, true) + '"';
}

std::string yaml_number(double value) {
  std::string text = concat(value);
  if (text.find('.') == std::string::npos) text.insert(std::min(text.find('e'), text.size()), ".0");
  return text;
}

// SPDX-License-Identifier: MIT
#include "../../tools/support/yaml_text.hpp"

#include <string>
#include <vector>

#include "support/catch.hpp"

TEST_CASE("A text stays in its line") {
  CHECK(escaped_line("a log.csv") == "a log.csv");
  CHECK(escaped_line("a\nrostopic: /evil") == "a\\nrostopic: /evil");
  CHECK(escaped_line("\r\t\x1b[31m\x7f") == "\\r\\t\\x1b[31m\\x7f");
  CHECK(escaped_line(std::string("a\0b", 3)) == "a\\x00b");
  CHECK(escaped_line("") == "");
  // YAML 1.1 takes these for ends of lines: next line, line separator, paragraph separator.
  CHECK(escaped_line("\xc2\x85") == "\\xc2\\x85");
  CHECK(escaped_line("\xe2\x80\xa8|\xe2\x80\xa9") == "\\xe2\\x80\\xa8|\\xe2\\x80\\xa9");
}

TEST_CASE("UTF-8 is kept, and nothing else beyond ASCII") {
  for (const std::string text :
       {"Größe", "日本語", "\xf0\x9f\x9a\x81", "\xc2\xa0", "\xef\xbf\xbd", "\xf4\x8f\xbf\xbf"}) {
    CHECK(escaped_line(text) == text);
  }
  CHECK(escaped_line("\xfc") == "\\xfc");                             // Latin-1
  CHECK(escaped_line("\xc3") == "\\xc3");                             // cut off
  CHECK(escaped_line("\xe2\x82x") == "\\xe2\\x82x");                  // cut off
  CHECK(escaped_line("\xc0\x8a") == "\\xc0\\x8a");                    // a newline in more bytes than it needs
  CHECK(escaped_line("\xe0\x80\x8a") == "\\xe0\\x80\\x8a");           // likewise
  CHECK(escaped_line("\xed\xa0\x80") == "\\xed\\xa0\\x80");           // a surrogate
  CHECK(escaped_line("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");  // beyond Unicode
  CHECK(escaped_line("\xef\xbf\xbf") == "\\xef\\xbf\\xbf");           // no character
  CHECK(escaped_line("\xef\xbb\xbf") == "\\xef\\xbb\\xbf");           // a byte order mark
}

TEST_CASE("A string as a value") {
  CHECK(yaml_string("/imu0") == "/imu0");
  CHECK(yaml_string("/camera/imu_1/data_raw") == "/camera/imu_1/data_raw");
  CHECK(yaml_string("imu") == "\"imu\"");
  CHECK(yaml_string("12") == "\"12\"");
  CHECK(yaml_string("") == "\"\"");
  CHECK(yaml_string("/a: b # c") == "\"/a: b # c\"");
  CHECK(yaml_string("a\"b\\c\nd") == "\"a\\\"b\\\\c\\nd\"");
}

TEST_CASE("Numbers are numbers to YAML 1.1, which wants a point, and read back to the same bits") {
  CHECK(yaml_number(5e-5) == "5.0e-05");
  CHECK(yaml_number(200) == "200.0");
  CHECK(yaml_number(1.9393e-5) == "1.9393e-05");
  CHECK(yaml_number(0.015) == "0.015");
  CHECK(yaml_number(1e20) == "1.0e+20");
  for (const double value : {1.0 / 3, 2e-300, 123456.789, 4e15}) CHECK(std::stod(yaml_number(value)) == value);
}

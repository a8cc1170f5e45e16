// SPDX-License-Identifier: MIT
// Any text, the name of a file for example, as a value and in a comment: no reader takes it for more than that.
#include "support/yaml_text.hpp"

#include <splinertia/io/number_text.hpp>
#include <string>

#include "fuzz/files.hpp"
#include "support/yaml_reader.hpp"

namespace splinertia::fuzz::yaml_text_target {

using namespace splinertia::detail;

const Target target{"yaml_text", [](Input input) {
                      static InputBytes file("text.yaml");
                      const double number = Input(input).bits<double>();
                      const std::string text(input.rest());
                      std::string yaml =
                          "# " + escaped_line(text) + "\nkey: " + yaml_string(text) + "  # " + escaped_line(text);
                      yaml += "\nnumber: " + yaml_number(has_finite_bits(number) ? number : 1) + '\n';
                      const YamlReader reader = YamlReader::open(file.with(yaml));
                      reader.expect_only({"key", "number"});
                      (void)reader["key"].text();
                      if (has_finite_bits(number)) {
                        const double read = reader["number"].number();
                        expect(read == number, "wrote ", yaml_number(number), ", read ", read);
                      }
                      bool plain = true;
                      for (const char c : text) plain = plain && c >= ' ' && c <= '~';
                      if (plain) expect(reader["key"].text() == text, "read ", reader["key"].text());
                    }};

}  // namespace splinertia::fuzz::yaml_text_target

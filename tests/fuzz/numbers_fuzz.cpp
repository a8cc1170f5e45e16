// SPDX-License-Identifier: MIT
// Any bytes as a file of one number a line, which has a fast path of its own for usual numbers.
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/text_file.hpp>

#include "fuzz/files.hpp"
#include "support/imu_log.hpp"

namespace splinertia::fuzz::numbers_target {

const Target target{"numbers", [](Input input) {
                      static InputBytes file("numbers.txt");
                      const std::string& path = file.with(input.rest());
                      std::vector<double> numbers;
                      const bool taken = accepted(path, [&] { numbers = read_numbers(path); });
                      // The same without the fast path.
                      TextFile lines(path);
                      std::size_t line = 0;
                      for (; lines.next(); ++line) {
                        const Parsed<double> number = parse_real(lines.line());
                        if (number.problem) return expect(!taken, "took ", excerpt(lines.line()));
                        if (!taken) continue;
                        expect(line < numbers.size() && number.value == numbers[line], "line ", line);
                      }
                      expect(taken && line == numbers.size(), line, " numbers, read ", numbers.size());
                    }};

}  // namespace splinertia::fuzz::numbers_target

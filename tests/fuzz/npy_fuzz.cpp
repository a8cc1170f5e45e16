// SPDX-License-Identifier: MIT
// Any bytes as a NumPy file, read with one of several dtypes.
#include <splinertia/io/detail/npy.hpp>
#include <string>

#include "fuzz/files.hpp"

namespace splinertia::fuzz::npy_target {

using namespace splinertia::detail;

struct Dtype {
  const char* text;
  std::size_t size;
};
constexpr std::array dtypes{Dtype{"'<f8'", 8}, Dtype{"'|u1'", 1}, Dtype{"[('t', '<i8'), ('v', '<f8', (3,))]", 32},
                            Dtype{"[('a', '|S70000')]", 70000}};

/// All records, one after the other.
std::string read_records(const std::string& path, const Dtype& dtype) {
  NpyReader reader(path, dtype.text, dtype.size);
  const std::size_t rows = reader.expected_rows();
  std::string records;
  while (reader.next()) records.append(reader.record(), dtype.size);
  expect(records.size() == rows * dtype.size && rows > 0, rows, " rows expected, ", records.size(), " bytes read");
  return records;
}

const Target target{"npy", [](Input input) {
                      static InputBytes file("records.npy");
                      const Dtype& dtype = dtypes[static_cast<std::size_t>(input.integer(0, dtypes.size() - 1))];
                      const std::string& path = file.with(input.rest());
                      std::string records;
                      if (!accepted(path, [&] { records = read_records(path, dtype); })) return;
                      const std::string copy = output_path();
                      NpyWriter writer(copy, dtype.text);
                      for (std::size_t at = 0; at < records.size(); at += dtype.size) {
                        records.copy(writer.room(dtype.size), dtype.size, at);
                        writer.advance(writer.room(dtype.size) + dtype.size);
                      }
                      writer.commit();
                      expect(read_records(copy, dtype) == records, "records have changed");
                    }};

}  // namespace splinertia::fuzz::npy_target

// SPDX-License-Identifier: MIT
// Any bytes as a table of one of many layouts.
#include <Eigen/Core>
#include <array>
#include <chrono>
#include <splinertia/io/stamped_table.hpp>
#include <splinertia/io/stamped_table_writer.hpp>
#include <vector>

#include "fuzz/files.hpp"

namespace splinertia::fuzz::stamped_table_target {

using namespace splinertia::detail;

constexpr std::array<std::string_view, 9> names{"t", "a", "b", "c", "d", "e", "f", "g", "h"};

struct Row {
  std::chrono::nanoseconds time;
  std::vector<double> values;
  bool operator==(const Row&) const = default;
};

std::vector<Row> read_rows(const std::string& path, const TableLayout& layout) {
  return read_stamped_table(path, layout, [&](const StampedTable& table) {
    Row row{table.time(), {}};
    for (std::size_t i = 1; i < layout.fewest_columns; ++i) row.values.push_back(table[i]);
    return row;
  });
}

const Target target{
    "stamped_table", [](Input input) {
      static InputBytes file("table.txt");
      const auto columns = static_cast<std::size_t>(input.integer(1, static_cast<int>(names.size())));
      const auto fewest = static_cast<std::size_t>(input.integer(1, static_cast<int>(columns)));
      TableLayout layout{.format = "a table",
                         .columns = std::span(names).first(columns),
                         .fewest_columns = fewest,
                         .stamp = input.flag() ? TableLayout::Stamp::seconds : TableLayout::Stamp::nanoseconds,
                         .separator = input.flag() ? ',' : ' ',
                         .header = input.flag()};
      const std::string& path = file.with(input.rest());
      std::vector<Row> rows;
      if (!accepted(path, [&] { rows = read_rows(path, layout); })) return;
      expect(!rows.empty(), "nothing was read, and nothing refused");
      layout.columns = layout.columns.first(fewest);
      const std::string copy = output_path();
      StampedTableWriter writer(copy, layout);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        expect(i == 0 || rows[i].time > rows[i - 1].time, "times do not increase at ", i);
        const auto& values = rows[i].values;
        for (const double value : values) expect(has_finite_bits(value), "read ", value);
        writer.append(rows[i].time, Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values)));
      }
      writer.commit();
      expect(read_rows(copy, layout) == rows, "rows have changed");
    }};

}  // namespace splinertia::fuzz::stamped_table_target

// SPDX-License-Identifier: MIT
#include <Eigen/Geometry>
#include <array>
#include <splinertia/io/detail/quaternion_track.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using Eigen::Quaterniond;

namespace {

constexpr std::array<std::string_view, 2> columns{"t", "x"};
constexpr TableLayout layout{.format = "rows",
                             .columns = columns,
                             .fewest_columns = 2,
                             .stamp = TableLayout::Stamp::nanoseconds,
                             .separator = ',',
                             .header = true};

// A table that stands in its third line.
struct Row {
  Row() { REQUIRE(table.next()); }
  test::TemporaryDirectory folder;
  std::filesystem::path path = folder.write("rows", "#t,x\n\n1,2\n");
  StampedTable table{path, layout};
};

}  // namespace

TEST_CASE("quaternions become unit within the tolerance and are refused beyond it") {
  const Row row;
  QuaternionTrack track;
  const Quaterniond unit(0.5, 0.5, -0.5, 0.5);
  for (const double norm : {0.99901, 0.9999, 1.0001, 1.00099}) {
    const Quaterniond scaled(norm * unit.coeffs());
    const Quaterniond q = track.next(row.table, scaled).unit_quaternion();
    CHECK_THAT(q.norm(), WithinAbs(1, 1e-15));
    CHECK_THAT((q.coeffs() - unit.coeffs()).norm(), WithinAbs(0, 1e-15));
  }
  for (const double norm : {0.0, 0.5, 0.9989, 1.0011, 1e300}) {
    CAPTURE(norm);
    const Quaterniond scaled(norm * unit.coeffs());
    CHECK_THROWS_AS(track.next(row.table, scaled), std::runtime_error);
  }
  CHECK(test::error_of<std::runtime_error>([&] { (void)track.next(row.table, Quaterniond(0, 0, 0, 0)); }) ==
        row.path.string() + ":3: quaternion with w x y z = 0 0 0 0 has norm 0, expected 1 within 0.001");
  CHECK(test::error_of<std::runtime_error>([&] { (void)track.next(row.table, Quaterniond(1.5, 0, 2, 0)); }) ==
        row.path.string() + ":3: quaternion with w x y z = 1.5 0 2 0 has norm 2.5, expected 1 within 0.001");
}

TEST_CASE("a quaternion that is unit but for rounding keeps its bits") {
  const Row row;
  QuaternionTrack track;
  const Quaterniond q(Eigen::Vector4d(1, 2, 3, 4).normalized() * (1 + 4e-16));
  CHECK(track.next(row.table, q).unit_quaternion().coeffs() == q.coeffs());
}

TEST_CASE("signs follow the predecessor, the first is kept") {
  const Row row;
  QuaternionTrack track;
  const Quaterniond a(-0.8, 0.6, 0, 0), b(0.6, -0.8, 0, 0), orthogonal(0, 0, -1, 0);
  CHECK(track.next(row.table, a).unit_quaternion().coeffs() == a.coeffs());
  CHECK(track.next(row.table, b).unit_quaternion().coeffs() == -b.coeffs());
  CHECK(track.next(row.table, b).unit_quaternion().coeffs() == -b.coeffs());
  CHECK(track.next(row.table, orthogonal).unit_quaternion().coeffs() == orthogonal.coeffs());
}

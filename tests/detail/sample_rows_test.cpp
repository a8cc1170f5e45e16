// SPDX-License-Identifier: MIT
#include <splinertia/detail/sample_rows.hpp>

#include <array>
#include <cstdint>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

TEST_CASE("rows are contiguous and hold what was written") {
  SampleRows<double, 3> rows;
  CHECK(rows.size() == 0);
  rows.resize(10);
  const SampleRows<double, 3>::Writer to(rows);
  for (std::size_t i = 0; i < 10; ++i) {
    to.write<0, 3>(i, std::array<double, 3>{static_cast<double>(i), 10.0 + static_cast<double>(i), -1});
  }
  CHECK(rows.size() == 10);
  CHECK(rows.rows<3>(0).cols() == 10);
  CHECK(rows.column<3>(0, 4) == Eigen::Vector3d(4, 14, -1));
  CHECK(rows.column<2>(1, 9) == Eigen::Vector2d(19, -1));
  CHECK(rows.rows<1>(1).data()[1] == 11);
}

TEST_CASE("whole vectors can be written up to the end of each row, and leave the other rows alone") {
  using L = NativeSimdPack<float>;
  for (std::size_t size = 1; size <= 2 * L::size + 1; ++size) {
    SampleRows<float, 2> rows;
    rows.resize(size);
    const SampleRows<float, 2>::Writer to(rows);
    to.write<1, 1>(0, std::array<float, 1>{-7.0F});
    to.write<0, 1>(size - 1, std::array<L, 1>{L::ramp()});
    CHECK(rows.column<1>(0, size - 1)[0] == 0);
    if (size > 1) CHECK(rows.column<2>(0, 0)[1] == -7);
  }
}

TEST_CASE("memory is kept where the size stays, and is part of the object where the capacity is given") {
  SampleRows<double, 2> rows;
  rows.resize(100);
  const double* const before = rows.rows<1>(0).data();
  rows.resize(100);
  CHECK(rows.rows<1>(0).data() == before);

  const SampleRows<double, 2, 16> fixed;
  CHECK(fixed.size() == 16);
  const auto address = reinterpret_cast<std::uintptr_t>(&fixed);
  const auto first = reinterpret_cast<std::uintptr_t>(fixed.rows<1>(0).data());
  CHECK((first >= address && first < address + sizeof(fixed)));
}

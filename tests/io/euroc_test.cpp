// SPDX-License-Identifier: MIT
// Real data: euroc_MH_05_pair/imu0.txt euroc_MH_05_pair/gt.csv
#include <filesystem>
#include <splinertia/io/euroc.hpp>

#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("both files of a EuRoC sequence share a clock", "[.real_data]") {
  const auto folder = std::filesystem::path(SPLINERTIA_TEST_DATA) / "euroc_MH_05_pair";
  const auto imu = read_euroc_imu(folder / "imu0.txt");
  const auto truth = read_euroc_groundtruth(folder / "gt.csv");
  REQUIRE(imu.size() == 22721);
  REQUIRE(truth.size() == 22212);
  CHECK(imu.front().time < truth.front().time);
  CHECK(truth.back().time < imu.back().time);
}

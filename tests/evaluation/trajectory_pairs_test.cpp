// SPDX-License-Identifier: MIT
#include <chrono>
#include <limits>
#include <splinertia/evaluation/trajectory_pairs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;

namespace {

using Split = SO3xR3<double>;
template <typename Time = double>
using Pairs = std::vector<PosePair<Split, Time>>;

std::string error_of(const auto& f) { return test::error_of<std::invalid_argument>(f); }

}  // namespace

TEST_CASE("Indices by frames") {
  CHECK(index_pairs_by_frames(6, 1) == IndexPairs{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}});
  CHECK(index_pairs_by_frames(6, 2) == IndexPairs{{0, 2}, {2, 4}});
  CHECK(index_pairs_by_frames(5, 2) == IndexPairs{{0, 2}, {2, 4}});
  CHECK(index_pairs_by_frames(5, 2, PairSelection::all) == IndexPairs{{0, 2}, {1, 3}, {2, 4}});
  CHECK(index_pairs_by_frames(3, 2) == IndexPairs{{0, 2}});
  for (const auto selection : {PairSelection::consecutive, PairSelection::all}) {
    CHECK(error_of([&] { (void)index_pairs_by_frames(3, 3, selection); }) ==
          "index_pairs_by_frames: delta 3, expected at least 1 and less than 3, the number of poses");
    CHECK(error_of([&] { (void)index_pairs_by_frames(3, 0, selection); }) != "");
    CHECK(error_of([&] { (void)index_pairs_by_frames(0, 1, selection); }) != "");
    CHECK(error_of([&] { (void)index_pairs_by_frames(3, std::numeric_limits<std::size_t>::max(), selection); }) != "");
  }
}

TEST_CASE("Indices by path: along the estimate, also when it comes back") {
  Pairs<> pairs(9);
  // Path lengths 0 1 2 2 2.5 3.5 3.75 6 7, back and forth.
  const double x[] = {0, 1, 0, 0, 0.5, -0.5, -0.25, 2, 3};
  for (std::size_t i = 0; i < 9; ++i) pairs[i].estimate = make_pose<Split>({}, {x[i], 0, 0});
  CHECK(index_pairs_by_path(pairs, 1) == IndexPairs{{0, 1}, {1, 2}, {2, 5}, {5, 7}, {7, 8}});
  CHECK(index_pairs_by_path(pairs, 2) == IndexPairs{{0, 2}, {2, 7}});
  CHECK(index_pairs_by_path(pairs, 7) == IndexPairs{{0, 8}});
  const auto all = PairSelection::all;
  CHECK(index_pairs_by_path(pairs, 1, all) == IndexPairs{{0, 1}, {1, 2}, {4, 5}, {7, 8}});
  // Standing still from 2 to 3: of two ends as good the first.
  CHECK(index_pairs_by_path(pairs, 2, all) == IndexPairs{{0, 2}});
  CHECK(index_pairs_by_path(pairs, 1.75, all, 0.15) == IndexPairs{{0, 2}, {1, 4}, {2, 6}, {3, 6}});
  CHECK(index_pairs_by_path(pairs, 2.25, all, 0.0) == IndexPairs{{6, 7}});
  // As good before as after: the one before.
  CHECK(index_pairs_by_path(pairs, 3, all, 0.2) == IndexPairs{{0, 4}, {1, 6}, {4, 7}, {5, 7}, {6, 8}});
  CHECK(error_of([&] { (void)index_pairs_by_path(pairs, 8); }) ==
        "index_pairs_by_path: no two of the 9 poses are 8 m apart along the path");
  CHECK(error_of([&] { (void)index_pairs_by_path(pairs, 8, all); }) != "");
  CHECK(error_of([&] { (void)index_pairs_by_path(pairs, 0); }) ==
        "index_pairs_by_path: delta 0 m, expected a length > 0");
  CHECK(error_of([&] { (void)index_pairs_by_path(pairs, std::numeric_limits<double>::quiet_NaN()); }) != "");
  CHECK(error_of([&] { (void)index_pairs_by_path(pairs, std::numeric_limits<double>::infinity()); }) != "");
  pairs.clear();
  CHECK(error_of([&] { (void)index_pairs_by_path(pairs, 1); }) != "");
  CHECK(error_of([&] { (void)index_pairs_by_path(pairs, 1, all); }) != "");
}

TEST_CASE("Indices by time: to the nearest pose") {
  Pairs<> pairs;
  // 10 Hz with jitter, nothing from 0.5 s to 1 s, and two pairs of one time.
  for (const double time : {0.0, 0.105, 0.2, 0.32, 0.4, 0.505, 1.0, 1.1, 1.1, 1.205}) pairs.push_back({time, {}, {}});
  const auto all = PairSelection::all;
  CHECK(index_pairs_by_time(pairs, 0.1) == IndexPairs{{0, 1}, {1, 2}, {4, 5}, {6, 7}, {7, 9}});
  CHECK(index_pairs_by_time(pairs, 0.1, PairSelection::consecutive, 0.25) ==
        IndexPairs{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {6, 7}, {7, 9}});
  CHECK(index_pairs_by_time(pairs, 0.1, all) == IndexPairs{{0, 1}, {1, 2}, {4, 5}, {6, 7}, {7, 9}, {8, 9}});
  CHECK(index_pairs_by_time(pairs, 0.2) == IndexPairs{{0, 2}, {2, 4}, {6, 9}});
  CHECK(index_pairs_by_time(pairs, 0.2, all) == IndexPairs{{0, 2}, {1, 3}, {2, 4}, {3, 5}, {6, 9}});
  CHECK(index_pairs_by_time(pairs, 1.21) == IndexPairs{{0, 9}});
  CHECK(error_of([&] { (void)index_pairs_by_time(pairs, 2); }) ==
        "index_pairs_by_time: no two of the 10 poses are 2 s apart");
  CHECK(error_of([&] { (void)index_pairs_by_time(pairs, 0); }) ==
        "index_pairs_by_time: delta 0 s, expected a duration > 0");
  CHECK(error_of([&] { (void)index_pairs_by_time(pairs, std::numeric_limits<double>::quiet_NaN()); }) != "");
  CHECK(error_of([&] { (void)index_pairs_by_time(pairs, std::numeric_limits<double>::infinity()); }) != "");
  pairs.clear();
  CHECK(error_of([&] { (void)index_pairs_by_time(pairs, 1); }) != "");

  // Nanoseconds since an epoch.
  Pairs<std::chrono::nanoseconds> stamped;
  for (int i = 0; i < 5; ++i) {
    stamped.push_back({std::chrono::nanoseconds(1403715524907143168 + 250'000'000 * i), {}, {}});
  }
  CHECK(index_pairs_by_time(stamped, 0.5, PairSelection::consecutive, 0.0) == IndexPairs{{0, 2}, {2, 4}});
}

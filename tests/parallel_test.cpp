// SPDX-License-Identifier: MIT
#include <splinertia/parallel.hpp>

#include <atomic>
#include <set>
#include <stdexcept>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;

TEST_CASE("every index is visited once, whatever the policy") {
  const auto visits = [](auto policy, std::size_t count) {
    std::vector<int> seen(count);
    for_each_index(policy, count, [&](std::size_t i) { ++seen[i]; });
    return seen;
  };
  for (const std::size_t count : {0u, 1u, 2u, 1000u}) {
    const std::vector<int> once(count, 1);
    CHECK(visits(SingleThread{}, count) == once);
    CHECK(visits(Parallel{}, count) == once);
    for (const unsigned threads : {1u, 2u, 7u}) CHECK(visits(Parallel{threads}, count) == once);
  }
}

TEST_CASE("one after the other in order, in this thread") {
  const auto here = std::this_thread::get_id();
  std::vector<std::size_t> order;
  for_each_index(SingleThread{}, 5, [&](std::size_t i) {
    order.push_back(i);
    CHECK(std::this_thread::get_id() == here);
  });
  CHECK(order == std::vector<std::size_t>{0, 1, 2, 3, 4});
}

TEST_CASE("as many threads as asked for work at once") {
  // Each waits until all three have begun, which they would never in fewer threads.
  std::atomic<int> begun{0};
  for_each_index(Parallel{3}, 3, [&](std::size_t) {
    ++begun;
    while (begun < 3) std::this_thread::yield();
  });
  CHECK(begun == 3);
}

TEST_CASE("an exception reaches the caller, and what has not begun is left out") {
  std::atomic<int> calls{0};
  const auto fail = [&](std::size_t i) {
    ++calls;
    if (i == 3) throw std::runtime_error("the fourth");
  };
  CHECK_THROWS_WITH(for_each_index(SingleThread{}, 100000, fail), "the fourth");
  CHECK(calls == 4);
  calls = 0;
  CHECK_THROWS_WITH(for_each_index(Parallel{2}, 100000, fail), "the fourth");
  CHECK(calls < 100000);
  CHECK_NOTHROW(for_each_index(Parallel{2}, 10, [](std::size_t) {}));
}

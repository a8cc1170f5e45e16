// SPDX-License-Identifier: MIT
/// Threads for independent pieces of work: axes of a log, runs of a simulation, curves of a data set. The library never
/// starts threads unless you pass `Parallel`. (On some systems a program with threads must be linked with the thread
/// library: CMake's Threads::Threads.)
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace splinertia {

/// All indices one after the other, in the calling thread.
struct SingleThread {};

/// Several indices at once, in `threads` threads including the calling one. 0: as many as the machine runs at once.
struct Parallel {
  unsigned threads = 0;
};

namespace detail {

template <typename P>
concept ExecutionPolicy = std::same_as<P, SingleThread> || std::same_as<P, Parallel>;

}  // namespace detail

/// f(0), f(1), …, f(count − 1).
inline void for_each_index(SingleThread, std::size_t count, const auto& f) {
  for (std::size_t i = 0; i < count; ++i) f(i);
}

/// f(0), …, f(count − 1) in any order and several at once. No f(i) may write what another one reads or writes. If each
/// f(i) writes only its own element i of a result, the result is the same as with one thread. Returns when all calls
/// are done. If some throw, calls that have not begun are skipped, and one of the exceptions is rethrown here.
inline void for_each_index(Parallel policy, std::size_t count, const auto& f) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr error;
  std::mutex error_mutex;
  const auto work = [&] {
    try {
      for (std::size_t i; (i = next++) < count;) f(i);
    } catch (...) {
      next = count;
      const std::lock_guard lock(error_mutex);
      error = std::current_exception();
    }
  };
  const std::size_t wanted = policy.threads > 0 ? policy.threads : (std::max)(1U, std::thread::hardware_concurrency());
  {
    struct Joined {  // in place of std::jthread, which libc++ has since version 18
      std::vector<std::thread> threads;
      ~Joined() {
        for (std::thread& thread : threads) thread.join();
      }
    } helpers;
    for (std::size_t thread = 1; thread < (std::min)(wanted, count); ++thread) helpers.threads.emplace_back(work);
    work();
  }
  if (error) std::rethrow_exception(error);
}

}  // namespace splinertia

// SPDX-License-Identifier: MIT
/// Threads for work of which no part depends on another: axes of a log, runs of a simulation, curves of a data set.
/// Nothing in the library starts a thread; who wants some says so. (Some systems want a program that does linked with
/// their thread library: CMake's Threads::Threads.)
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

/// One after the other in the thread that calls.
struct SingleThread {};

/// Several at once, in so many threads, that which calls among them; 0: as many as the machine runs at once.
struct Parallel {
  unsigned threads = 0;
};

template <typename P>
concept ExecutionPolicy = std::same_as<P, SingleThread> || std::same_as<P, Parallel>;

/// f(0), f(1), …, f(count − 1).
inline void for_each_index(SingleThread, std::size_t count, const auto& f) {
  for (std::size_t i = 0; i < count; ++i) f(i);
}

/// The same in any order and several at once, so that no f(i) may write what another reads or writes; a result that
/// f(i) alone writes at place i is the same as that of one thread. Returns when all are done. If some throw, those that
/// have not begun are left out, and one of the exceptions is thrown here.
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
    struct Joined {  // std::jthread, which libc++ has since version 18
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

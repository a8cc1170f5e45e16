// SPDX-License-Identifier: MIT
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <string>

/// A progress bar on standard error: only on a terminal, and only if the work takes longer than a second.
class Progress {
 public:
  explicit Progress(std::size_t total) : total_(total), watched_(isatty(STDERR_FILENO) == 1) {}
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress() {
    if (drawn_) std::fputs("\r\033[K", stderr);
  }

  void advance(std::size_t amount = 1) {
    done_ += amount;
    // Reading the clock has a cost, so it is read once in 1024 steps.
    if (++steps_ % 1024 != 0 || !watched_) return;
    const auto now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(200);
    drawn_ = true;
    const double share = static_cast<double>(done_) / static_cast<double>(total_);
    const double elapsed = std::chrono::duration<double>(now - start_).count();
    const auto filled = static_cast<std::size_t>(share * 40);
    std::fprintf(stderr, "\r[%s%s] %3.0f %%, %.0f s left ", std::string(filled, '=').c_str(),
                 std::string(40 - filled, ' ').c_str(), share * 100, elapsed / share - elapsed);
    std::fflush(stderr);
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::size_t total_;
  std::size_t done_ = 0;
  std::size_t steps_ = 0;
  bool watched_;
  bool drawn_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_ + std::chrono::seconds(1);
};

/// Shows what is being done, for work of unknown length. Also on standard error, and only on a terminal.
class Stage {
 public:
  explicit Stage(const char* what) : watched_(isatty(STDERR_FILENO) == 1) {
    if (watched_) std::fprintf(stderr, "\r\033[K%s ...", what);
  }
  Stage(const Stage&) = delete;
  Stage& operator=(const Stage&) = delete;
  ~Stage() {
    if (watched_) std::fputs("\r\033[K", stderr);
  }

 private:
  bool watched_;
};

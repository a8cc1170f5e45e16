// SPDX-License-Identifier: MIT
/// The memory of Allan analysis.
#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <optional>
#include <splinertia/allan/curve.hpp>
#include <splinertia/allan/identify.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "../support/harness.hpp"
#include "logs.hpp"

namespace {

struct Usage {
  double input, peak, seconds;  // MiB
};

double peak_now() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Of a process that analyses so many samples.
std::optional<Usage> usage_of(std::size_t n, void (*work)(const std::vector<double>& y)) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) return std::nullopt;
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    const std::vector<double> y = white_signal(n);
    Usage usage{peak_now(), 0, 0};
    const auto start = std::chrono::steady_clock::now();
    work(y);
    usage.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    usage.peak = peak_now();
    _exit(write(ends[1], &usage, sizeof usage) == sizeof usage ? 0 : 1);
  }
  close(ends[1]);
  Usage usage{};
  const bool got = read(ends[0], &usage, sizeof usage) == sizeof usage;
  close(ends[0]);
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child || status != 0 || !got) return std::nullopt;
  return usage;
}

void print_memory(bool csv, const Settings& settings) {
  const auto print = [&](const std::string& name, std::size_t n, void (*work)(const std::vector<double>&)) {
    const auto usage = usage_of(n, work);
    if (!usage) throw std::runtime_error("no process could be started, or it failed");
    const double input = static_cast<double>(n) * 8 / (1 << 20);
    const double share = (usage->peak - usage->input) / input;
    benchmark::figure(csv, "memory_" + name, share, "1");
    benchmark::figure(csv, "peak_memory_" + name, usage->peak, "MiB");
    benchmark::figure(csv, "process_" + name + "_s", usage->seconds, "s");
    if (!csv) {
      std::printf("%-20s %9.3g samples: %8.2f times the input beyond it, peak of the process %7.1f MiB, %.2f s\n",
                  name.c_str(), static_cast<double>(n), share, usage->peak, usage->seconds);
    }
  };
  if (!csv) std::printf("\nMemory of a process of its own\n");
  const auto oadev = [](const std::vector<double>& y) { benchmark::keep(allan::overlapping(y, rate)); };
  print("overlapping", settings.samples, oadev);
  print("identify", settings.samples, [](const std::vector<double>& y) { benchmark::keep(identify(y, rate)); });
  if (settings.huge) print("overlapping_1e8", 100'000'000, oadev);
}

}  // namespace

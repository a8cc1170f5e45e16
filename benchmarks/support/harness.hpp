// SPDX-License-Identifier: MIT
/// What the benchmark programs share: a list of kernels, their times, and their instruction counts.
///
/// Times are of a shared machine and only good for ratios within one run: minimum and median of many repetitions are
/// given. Instructions are counted by valgrind (callgrind) in a twin of the program that is compiled for x86-64-v3, since
/// valgrind knows no AVX-512: two runs of different length, so that everything around the calls cancels.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace benchmark {

/// Makes the compiler believe that somebody reads *value.
inline void keep(const auto& value) { asm volatile("" : : "r"(&value) : "memory"); }

struct Kernel {
  std::string name;                            // as in --csv: letters, digits and underscores
  std::function<void(std::size_t calls)> run;  // calls the function under test so many times
};

struct Times {
  double min, median;  // ns a call
};

inline Times measure(const Kernel& kernel, std::size_t calls) {
  std::vector<double> times;
  kernel.run(calls);
  for (int repetition = 0; repetition < 41; ++repetition) {
    const auto start = std::chrono::steady_clock::now();
    kernel.run(calls);
    const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
    times.push_back(elapsed.count() / static_cast<double>(calls));
  }
  std::sort(times.begin(), times.end());
  return {times.front(), times[times.size() / 2]};
}

/// Instructions that valgrind counts for the whole run of `program --only NAME --calls N`; nothing where it cannot.
inline std::optional<double> count_run(const std::string& program, const std::string& name, std::size_t calls) {
  const std::string command = "valgrind --tool=callgrind --callgrind-out-file=/dev/null '" + program + "' --only " + name +
                              " --calls " + std::to_string(calls) + " 2>&1";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return std::nullopt;
  std::optional<double> collected;
  char line[512];
  while (std::fgets(line, sizeof line, pipe)) {
    const std::string text(line);
    const auto at = text.find("Collected : ");
    if (at != std::string::npos) collected = std::stod(text.substr(at + 12));
  }
  return pclose(pipe) == 0 ? collected : std::nullopt;
}

/// Instructions of one call.
inline std::optional<double> count(const std::string& program, const std::string& name) {
  constexpr std::size_t few = 1000, many = 3000;
  const auto short_run = count_run(program, name, few), long_run = count_run(program, name, many);
  if (!short_run || !long_run) return std::nullopt;
  return (*long_run - *short_run) / static_cast<double>(many - few);
}

/// The main() of a benchmark program.
inline int run(int argc, char** argv, const char* description, const std::vector<Kernel>& kernels) {
  CLI::App app{description};
  bool csv = false, instructions = false;
  std::string only, filter;
  std::size_t calls = 20000;
  app.add_flag("--csv", csv, "one line a figure: name,value,unit");
  app.add_flag("--instructions", instructions, "count instructions, too (needs valgrind; minutes)");
  app.add_option("--filter", filter, "only kernels whose name contains this");
  app.add_option("--calls", calls, "calls a repetition")->capture_default_str();
  app.add_option("--only", only, "just call this kernel, without timing: for profilers");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (!only.empty()) {
    const auto kernel = std::find_if(kernels.begin(), kernels.end(), [&](const Kernel& k) { return k.name == only; });
    if (kernel == kernels.end()) {
      std::fprintf(stderr, "%s: no kernel %s\n", argv[0], only.c_str());
      return 2;
    }
    kernel->run(calls);
    return 0;
  }
  const std::string twin = std::filesystem::canonical("/proc/self/exe").string() + "_x86_64_v3";
  if (!csv) std::printf("%-34s %10s %10s %s\n", "", "min [ns]", "median", instructions ? "instructions" : "");
  for (const Kernel& kernel : kernels) {
    if (kernel.name.find(filter) == std::string::npos) continue;
    const Times times = measure(kernel, calls);
    const auto counted = instructions ? count(twin, kernel.name) : std::nullopt;
    if (csv) {
      std::printf("%s_ns,%.2f,ns\n%s_median_ns,%.2f,ns\n", kernel.name.c_str(), times.min, kernel.name.c_str(), times.median);
      if (counted) std::printf("%s_instructions,%.1f,instructions\n", kernel.name.c_str(), *counted);
    } else {
      std::printf("%-34s %10.1f %10.1f", kernel.name.c_str(), times.min, times.median);
      counted ? std::printf(" %12.0f\n", *counted) : std::printf("\n");
    }
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace benchmark

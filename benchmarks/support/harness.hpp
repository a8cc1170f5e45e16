// SPDX-License-Identifier: MIT
/// What the benchmark programs share: a list of kernels, their times, and their instruction counts.
///
/// Times are of a shared machine and only good for ratios within one run: minimum and median of many repetitions are
/// given. Instructions are counted by valgrind (callgrind) in a twin of the program that is compiled for x86-64-v3,
/// since valgrind knows no AVX-512: two runs of different length, so that everything around the calls cancels.
#pragma once

#include <stdlib.h>  // mkdtemp

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
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
  double min, median, max;  // ns a call
};

/// Times of several kernels in turn, so that what else the machine does meets all of them.
inline std::vector<Times> measure_in_turn(const std::vector<Kernel>& kernels, std::size_t calls) {
  std::vector<std::vector<double>> times(kernels.size());
  for (const Kernel& kernel : kernels) kernel.run(calls);
  for (int repetition = 0; repetition < 41; ++repetition) {
    for (std::size_t k = 0; k < kernels.size(); ++k) {
      const auto start = std::chrono::steady_clock::now();
      kernels[k].run(calls);
      const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
      times[k].push_back(elapsed.count() / static_cast<double>(calls));
    }
  }
  std::vector<Times> result;
  for (auto& t : times) {
    std::sort(t.begin(), t.end());
    result.push_back({t.front(), t[t.size() / 2], t.back()});
  }
  return result;
}

inline Times measure(const Kernel& kernel, std::size_t calls) { return measure_in_turn({kernel}, calls).front(); }

/// valgrind writes down what it has counted since the last time when this returns.
extern "C" [[gnu::noinline]] inline void splinertia_benchmark_mark() { asm volatile("" : : : "memory"); }

/// The run that count() looks at.
inline void run_marked(const std::vector<Kernel>& kernels, std::size_t few, std::size_t many) {
  for (const Kernel& kernel : kernels) {
    kernel.run(few);
    for (const std::size_t calls : {std::size_t{0}, few, many}) {
      if (calls > 0) kernel.run(calls);
      splinertia_benchmark_mark();
    }
  }
}

/// The program whose instructions can be counted: the twin where there is one, else this one.
inline std::string countable_program() {
  const std::string self = std::filesystem::canonical("/proc/self/exe").string(), twin = self + "_x86_64_v3";
  return std::filesystem::exists(twin) ? twin : self;
}

/// Instructions of one call of each kernel whose name contains `filter`; nothing where valgrind is missing or fails.
inline std::optional<std::vector<double>> count(const std::string& filter) {
  constexpr std::size_t few = 1000, many = 3000;
  std::string folder = (std::filesystem::temp_directory_path() / "splinertia_benchmark_XXXXXX").string();
  if (!mkdtemp(folder.data())) return std::nullopt;
  const std::string command = "valgrind --tool=callgrind --dump-after=splinertia_benchmark_mark " +
                              ("--callgrind-out-file='" + folder + "/counts' '") + countable_program() +
                              "' --marked --filter '" + filter + "' > '" + folder + "/log' 2>&1";
  std::optional<std::vector<double>> result;
  if (std::system(command.c_str()) == 0) {
    std::vector<double> counts;
    for (int part = 1;; ++part) {
      std::ifstream file(folder + "/counts." + std::to_string(part));
      if (!file) break;
      for (std::string line; std::getline(file, line);) {
        if (line.starts_with("totals: ")) counts.push_back(std::stod(line.substr(8)));
      }
    }
    result.emplace();
    for (std::size_t i = 0; i + 2 < counts.size(); i += 3)
      result->push_back((counts[i + 2] - counts[i + 1]) / static_cast<double>(many - few));
  }
  std::filesystem::remove_all(folder);
  return result;
}

/// One figure for machines, or nothing.
inline void figure(bool csv, const std::string& name, double value, const char* unit) {
  if (csv) std::printf("%s,%.6g,%s\n", name.c_str(), value, unit);
}

/// What a program does beside measuring its kernels.
struct Extension {
  std::function<void(CLI::App& app)> options = [](CLI::App&) {};
  std::function<std::optional<int>()> instead = [] { return std::nullopt; };  // exit code, if it was asked for
  std::function<void(bool csv, std::size_t calls)> figures = [](bool, std::size_t) {};
};

/// The main() of a benchmark program.
inline int run(int argc, char** argv, const char* description, const std::vector<Kernel>& all,
               const Extension& extension = {}) {
  CLI::App app{description};
  bool csv = false, instructions = false, marked = false;
  std::string only, filter;
  std::size_t calls = 20000;
  app.add_flag("--csv", csv, "one line a figure: name,value,unit");
  app.add_flag("--instructions", instructions, "count instructions, too (needs valgrind)");
  app.add_option("--filter", filter, "only kernels whose name contains this");
  app.add_option("--calls", calls, "calls a repetition")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--only", only, "just call this kernel, without timing: for profilers");
  app.add_flag("--marked", marked)->group("");  // hidden
  extension.options(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (!only.empty()) {
    const auto kernel = std::find_if(all.begin(), all.end(), [&](const Kernel& k) { return k.name == only; });
    if (kernel == all.end()) {
      std::fprintf(stderr, "%s: no kernel %s\n", argv[0], only.c_str());
      return 2;
    }
    kernel->run(calls);
    return 0;
  }
  std::vector<Kernel> kernels;
  for (const Kernel& kernel : all) {
    if (kernel.name.find(filter) != std::string::npos) kernels.push_back(kernel);
  }
  if (marked) {
    run_marked(kernels, 1000, 3000);
    return 0;
  }
  if (const auto code = extension.instead()) return *code;
  const auto counted = instructions ? count(filter) : std::nullopt;
  if (instructions && (!counted || counted->size() != kernels.size()))
    std::fprintf(stderr, "%s: instructions were not counted, because valgrind is missing or failed\n", argv[0]);
  if (!csv) std::printf("%-42s %10s %10s %s\n", "", "min [ns]", "median", counted ? "instructions" : "");
  for (std::size_t k = 0; k < kernels.size(); ++k) {
    const std::string& name = kernels[k].name;
    const Times times = measure(kernels[k], calls);
    const bool has_count = counted && k < counted->size();
    if (csv) {
      std::printf("%s_ns,%.2f,ns\n%s_median_ns,%.2f,ns\n", name.c_str(), times.min, name.c_str(), times.median);
      if (has_count) std::printf("%s_instructions,%.1f,instructions\n", name.c_str(), (*counted)[k]);
    } else {
      std::printf("%-42s %10.1f %10.1f", name.c_str(), times.min, times.median);
      has_count ? std::printf(" %12.0f\n", (*counted)[k]) : std::printf("\n");
    }
    std::fflush(stdout);
  }
  extension.figures(csv, calls);
  return 0;
}

}  // namespace benchmark

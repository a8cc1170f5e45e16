// SPDX-License-Identifier: MIT
/// Zero overhead, checked: pairs of functions that come to the same results, one of them composed from the library, the
/// other written by hand, and the instructions and machine code that both take.
#pragma once

#include <stdio.h>  // popen

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "harness.hpp"

namespace benchmark {

/// How many more instructions than by hand are let pass. One side only: fewer are welcome.
///
/// Counts repeat to the digit, but a compiler is no more careful with one of two equal functions than with the other:
/// which of them moves one value more between registers and the stack changes with every edit. Hence 2 %, which one
/// virtual call, allocation or copy of a pose too many exceeds. In functions of less than 150 instructions that would
/// be one or two, so there 4 are let pass.
struct Tolerance {
  double part = 0.02;
  double few = 4;  // in short functions

  [[nodiscard]] bool passes(double library, double by_hand) const {
    return library - by_hand <= std::max(part * by_hand, by_hand < 150 ? few : 0);
  }
};

struct Pair {
  Kernel library, by_hand;
  std::function<double()> difference;  // of the results, over what rounding explains: at most 1
  std::optional<Kernel> inlined = {};  // by hand again, as the compiler would have it at best: listed, no limit
  Tolerance tolerance = {};
};

/// Whether all pairs come to the same results: to the last bit, or to rounding, since compilers contract a·b + c as
/// they like.
inline bool same_results(const std::vector<Pair>& pairs) {
  bool same = true;
  for (const Pair& pair : pairs) {
    const double difference = pair.difference();
    if (difference <= 1) continue;
    std::fprintf(stderr, "%s: the results differ from those by hand by %g times what rounding explains\n",
                 pair.library.name.c_str(), difference);
    same = false;
  }
  return same;
}

/// All functions of the pairs, in turn: what a program with check_overhead() gives run() first. Names have a '_'.
inline std::vector<Kernel> kernels_of(const std::vector<Pair>& pairs) {
  std::vector<Kernel> kernels;
  for (const Pair& pair : pairs) {
    kernels.push_back(pair.library);
    kernels.push_back(pair.by_hand);
    if (pair.inlined) kernels.push_back(*pair.inlined);
  }
  return kernels;
}

/// Compares the instructions of all pairs, each for one `unit`. Returns the exit code.
inline int check_overhead(const std::vector<Pair>& pairs, const char* unit) {
  const auto counted = count("_");
  if (!counted || counted->size() < kernels_of(pairs).size()) {
    std::printf("skipped: instructions were not counted, because valgrind is missing or failed\n");
    return 0;
  }
  const bool inlined = std::any_of(pairs.begin(), pairs.end(), [](const Pair& p) { return p.inlined.has_value(); });
  bool good = true;
  std::printf("%-36s %10s %10s %10s %10s\n", (std::string("instructions a ") + unit).c_str(), "library", "by hand", "",
              inlined ? "all inlined" : "");
  auto count = counted->begin();
  for (const Pair& pair : pairs) {
    const double library = *count++, by_hand = *count++;
    const bool passes = pair.tolerance.passes(library, by_hand);
    std::printf("%-36s %10.1f %10.1f %+8.1f %%", pair.library.name.c_str(), library, by_hand,
                100 * (library / by_hand - 1));
    if (pair.inlined) std::printf(" %11.1f", *count++);
    std::printf(" %s\n", passes ? "" : "FAILED");
    good = good && passes;
  }
  return good ? 0 : 1;
}

/// The machine code of a function and of all that it calls, bytes; what comes from shared libraries is not counted.
struct CodeSize {
  std::size_t usual = 0;  // without what the compiler has put aside as unlikely (.cold), as errors and their messages
  std::size_t all = 0;
};

/// Sizes of the functions of the program whose instructions are counted, by their names, which must not be overloaded.
/// Nothing without objdump of GNU binutils, or where the program has been stripped.
class CodeSizes {
 public:
  CodeSizes() {
    const std::string command = "objdump --syms --disassemble --no-show-raw-insn '" + countable_program() + "' 2>&1";
    FILE* output = popen(command.c_str(), "r");
    if (!output) return;
    std::string line, function;
    for (int c = 0; (c = std::fgetc(output)) != EOF;) {
      if (c != '\n') {
        line.push_back(static_cast<char>(c));
        continue;
      }
      read(line, function);
      line.clear();
    }
    pclose(output);
  }

  /// Of a function or, with a function template and its first argument, of that instance of it.
  [[nodiscard]] std::optional<CodeSize> of(const std::string& function, const std::string& argument = "") const {
    const auto mangled = [](const std::string& name) { return std::to_string(name.size()) + name; };
    const auto symbol = std::find_if(bytes_.begin(), bytes_.end(), [&](const auto& s) {
      const std::string& name = s.first;
      if (name.find('.') != std::string::npos) return false;  // a part of a function
      if (argument.empty()) return name.starts_with("_Z" + mangled(function));
      const auto at = name.find(mangled(function) + 'I');
      return at != std::string::npos && name.find("_Z" + mangled(argument), at) != std::string::npos;
    });
    if (symbol == bytes_.end()) return std::nullopt;
    return CodeSize{reachable(symbol->first, false), reachable(symbol->first, true)};
  }

 private:
  [[nodiscard]] std::size_t reachable(const std::string& function, bool unlikely) const {
    std::set<std::string> seen;
    std::vector<std::string> open{function};
    std::size_t sum = 0;
    while (!open.empty()) {
      const std::string name = open.back();
      open.pop_back();
      if (!unlikely && name.find(".cold") != std::string::npos) continue;
      const auto found = bytes_.find(name);
      if (found == bytes_.end() || !seen.insert(name).second) continue;  // of a shared library, or counted already
      sum += found->second;
      if (const auto calls = calls_.find(name); calls != calls_.end()) {
        open.insert(open.end(), calls->second.begin(), calls->second.end());
      }
    }
    return sum;
  }

  void read(const std::string& line, std::string& function) {
    const auto tab = line.find('\t'), open = line.find('<');
    if (tab != std::string::npos && line.find(" F ") < tab) {
      // A symbol: address, flags with F for a function, section, tab, size, perhaps ".hidden", name.
      const std::size_t size = std::stoul(line.substr(tab + 1), nullptr, 16);
      if (size > 0) bytes_[line.substr(line.find_last_of(' ') + 1)] = size;
    } else if (line.ends_with(">:")) {
      function = line.substr(open + 1, line.size() - open - 3);
    } else if (open != std::string::npos && line.ends_with(">") && line.find('#') == std::string::npos) {
      // A call or a jump; other instructions have the address that they use behind a '#'.
      calls_[function].insert(line.substr(open + 1, line.find_first_of("+>", open) - open - 1));
    }
  }

  std::map<std::string, std::size_t> bytes_;
  std::map<std::string, std::set<std::string>> calls_;
};

/// Lists the machine code of all pairs, whose functions are called as their kernels are; `inlined` is the template that
/// has functions by hand inlined.
inline void print_sizes(const std::vector<Pair>& pairs, const std::string& inlined) {
  const CodeSizes sizes;
  std::printf("%-36s %10s %10s %12s %16s\n", "bytes of machine code", "library", "by hand", "all inlined",
              "library's errors");
  for (const Pair& pair : pairs) {
    const auto library = sizes.of(pair.library.name), by_hand = sizes.of(pair.by_hand.name),
               at_best = sizes.of(inlined, pair.by_hand.name);
    if (!library || !by_hand || !at_best) {
      std::printf(
          "skipped: there are no sizes, because objdump (GNU binutils) is missing or the program is stripped\n");
      return;
    }
    std::printf("%-36s %10zu %10zu %12zu %16zu\n", pair.library.name.c_str(), library->usual, by_hand->usual,
                at_best->usual, library->all - library->usual);
  }
}

/// The options --check-overhead and, where the functions have names of their own, --sizes.
struct OverheadOptions {
  bool check = false, sizes = false;
  std::string inlined = {};  // the template that has functions by hand inlined

  void add(CLI::App& app) {
    app.add_flag("--check-overhead", check,
                 "only compare instructions with those of functions by hand (needs valgrind); exit code 1 if there "
                 "are more than the tolerance lets pass");
    if (!inlined.empty()) app.add_flag("--sizes", sizes, "only list bytes of machine code (needs objdump)");
  }

  /// Compares results, and what was asked for: the exit code, if the program is to end.
  [[nodiscard]] std::optional<int> run(const std::vector<Pair>& pairs, const char* unit) const {
    if (!same_results(pairs)) return 1;
    if (sizes) print_sizes(pairs, inlined);
    if (check) return check_overhead(pairs, unit);
    return sizes ? std::optional(0) : std::nullopt;
  }
};

}  // namespace benchmark

// SPDX-License-Identifier: MIT
// Runs targets on kept inputs, with any compiler: fuzz_replay TARGET FOLDER. Exit code 1: a fault, which is named.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/fuzz.hpp"

namespace {

using splinertia::fuzz::Fault;
using splinertia::fuzz::Target;

int fail(const std::string& what) {
  std::fprintf(stderr, "fuzz_replay: %s\n", what.c_str());
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return fail("expected TARGET FOLDER");
  const auto& targets = Target::all();
  const auto named = [&](const Target* target) { return target->name == std::string_view(argv[1]); };
  const auto target = std::find_if(targets.begin(), targets.end(), named);
  if (target == targets.end()) return fail(std::string("no target ") + argv[1]);

  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(argv[2])) paths.push_back(entry.path());
  if (paths.empty()) return fail(std::string(argv[2]) + ": no inputs");
  std::sort(paths.begin(), paths.end());
  for (const auto& path : paths) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    try {
      (*target)->run({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    } catch (const Fault& fault) {
      return fail(path.string() + ": " + fault.text);
    } catch (const std::exception& error) {
      return fail(path.string() + ": an exception that should not be: " + error.what());
    }
  }
  std::printf("%zu inputs\n", paths.size());
}

// SPDX-License-Identifier: MIT
// The entry of libFuzzer, linked with the source of one target. Any fault is a crash for it.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using splinertia::fuzz::Target;
  try {
    Target::all().front()->run({data, size});
  } catch (const splinertia::fuzz::Fault& fault) {
    std::fprintf(stderr, "fault: %s\n", fault.text.c_str());
    std::abort();
  }
  return 0;
}

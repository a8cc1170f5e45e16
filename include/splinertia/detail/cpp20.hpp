// SPDX-License-Identifier: MIT
/// The first thing that every other header reads: one error for those who compile with an older standard.
#pragma once

#if __cplusplus < 202002L
#error splinertia needs C++20: compile with -std=c++20 or newer, or link the CMake target splinertia::splinertia
#include <splinertia/stop>  // There is none: compilers go on after #error, for hundreds of lines, but not after this.
#endif

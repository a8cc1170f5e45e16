// SPDX-License-Identifier: MIT
/// Every other header includes this one, directly or not: it gives one clear error for a standard before C++20.
#pragma once

#if __cplusplus < 202002L
#error splinertia needs C++20: compile with -std=c++20 or newer, or link the CMake target splinertia::splinertia
#include <splinertia/stop>  // No such file: compilers go on for hundreds of lines after #error, but not after this.
#endif

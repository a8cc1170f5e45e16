// SPDX-License-Identifier: MIT
/// Attributes that say what is inlined. The loops over samples consist of many small functions (error terms, normal
/// numbers, integration steps). Compilers weigh the size of a whole loop and stop inlining half-way through it. Then the
/// state goes through memory in every sample, at up to twice the instructions. So the functions of a sample are always
/// inlined, and what rarely runs (errors, the first sample, irregular intervals) stays out of the loop.
#pragma once

#include <splinertia/detail/cpp20.hpp>

#ifdef __GNUC__
/// For a function of each sample.
#define SPLINERTIA_ALWAYS_INLINE [[gnu::always_inline]]
/// For a function that runs once per loop, and whose code would be repeated in each loop.
#define SPLINERTIA_NOINLINE [[gnu::noinline]]
/// For a function that rarely runs. It is not inlined, and branches that call it are unlikely.
#define SPLINERTIA_COLD [[gnu::noinline, gnu::cold]]
#else
#define SPLINERTIA_ALWAYS_INLINE
#define SPLINERTIA_NOINLINE
#define SPLINERTIA_COLD
#endif

// SPDX-License-Identifier: MIT
#pragma once

#include <splinertia/detail/cpp20.hpp>

#include <Eigen/Core>
#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>

namespace splinertia::detail {

/// A SIMD pack: N numbers (lanes) that go through the same arithmetic at once. It can be the Scalar of every template
/// of this library that never branches on one; each operation is one SIMD instruction or a few. It has no comparisons,
/// so that code which would branch on it does not compile.
///
/// The numbers are kept in vectors of Bytes bytes, by the vector extension of g++ and clang, which compiles to what the
/// target has; there are no intrinsics. Width and number of the vectors are part of the type's name. Functions compiled
/// for different targets are therefore different functions to the linker.
template <typename T, int N, int Bytes>
struct SimdPack {
  using Vector [[gnu::vector_size(Bytes)]] = T;
  static constexpr int size = N;
  static constexpr int width = Bytes / static_cast<int>(sizeof(T));
  static constexpr int vectors = N / width;
  static_assert(vectors * width == N, "lanes fill whole vectors");

  Vector vector[static_cast<std::size_t>(vectors)];

  SimdPack() = default;  // uninitialised, as T is
  /// x in all lanes; −0 stays −0.
  SimdPack(T x) {
    for (Vector& v : vector) v = x - Vector{};
  }

  /// The N numbers from p on. p need not be aligned.
  [[nodiscard]] static SimdPack load(const T* p) {
    SimdPack x;
    std::memcpy(x.vector, p, sizeof(x.vector));
    return x;
  }
  void store(T* p) const { std::memcpy(p, vector, sizeof(vector)); }

  /// 0, 1, …, N − 1.
  [[nodiscard]] static SimdPack ramp() {
    SimdPack x(T(0));
    for (int i = 0; i < N; ++i) x.vector[i / width][i % width] = static_cast<T>(i);
    return x;
  }

  SimdPack& operator+=(const SimdPack& b) {
    for (int i = 0; i < vectors; ++i) vector[i] += b.vector[i];
    return *this;
  }
  SimdPack& operator-=(const SimdPack& b) {
    for (int i = 0; i < vectors; ++i) vector[i] -= b.vector[i];
    return *this;
  }
  SimdPack& operator*=(const SimdPack& b) {
    for (int i = 0; i < vectors; ++i) vector[i] *= b.vector[i];
    return *this;
  }
  SimdPack& operator/=(const SimdPack& b) {
    for (int i = 0; i < vectors; ++i) vector[i] /= b.vector[i];
    return *this;
  }
  friend SimdPack operator+(SimdPack a, const SimdPack& b) { return a += b; }
  friend SimdPack operator-(SimdPack a, const SimdPack& b) { return a -= b; }
  friend SimdPack operator*(SimdPack a, const SimdPack& b) { return a *= b; }
  friend SimdPack operator/(SimdPack a, const SimdPack& b) { return a /= b; }
  friend SimdPack operator-(SimdPack a) {
    for (Vector& v : a.vector) v = -v;
    return a;
  }
};

template <typename T>
inline constexpr bool is_simd_pack = false;
template <typename T, int N, int Bytes>
inline constexpr bool is_simd_pack<SimdPack<T, N, Bytes>> = true;

/// The same numbers in another type, each rounded as static_cast does.
template <typename To, typename T, int N, int Bytes>
[[nodiscard]] inline SimdPack<To, N, Bytes> simd_pack_cast(const SimdPack<T, N, Bytes>& x) {
  if constexpr (std::is_same_v<To, T>) {
    return x;
  } else {
    using From [[gnu::vector_size(N * sizeof(T))]] = T;
    using Into [[gnu::vector_size(N * sizeof(To))]] = To;
    From from;
    std::memcpy(&from, x.vector, sizeof(from));
    const Into into = __builtin_convertvector(from, Into);
    SimdPack<To, N, Bytes> y;
    std::memcpy(y.vector, &into, sizeof(into));
    return y;
  }
}

/// Bytes of the widest vector that this target computes with, and how many vectors a function processes side by side.
/// Where vectors are narrow, a function's chain of dependent operations leaves the processor idle; two vectors then
/// take little longer than one.
#if defined(__AVX512F__)
inline constexpr int vector_bytes = 64, vectors_at_once = 1;
#elif defined(__AVX__)
inline constexpr int vector_bytes = 32, vectors_at_once = 1;
#else
inline constexpr int vector_bytes = 16, vectors_at_once = 2;
#endif

/// The SIMD pack of T that suits this target.
template <typename T>
using NativeSimdPack = SimdPack<T, vectors_at_once * vector_bytes / static_cast<int>(sizeof(T)), vector_bytes>;

}  // namespace splinertia::detail

template <typename T, int N, int Bytes>
struct std::numeric_limits<splinertia::detail::SimdPack<T, N, Bytes>> : std::numeric_limits<T> {};

template <typename T, int N, int Bytes>
struct Eigen::NumTraits<splinertia::detail::SimdPack<T, N, Bytes>> : Eigen::GenericNumTraits<T> {
  using Real = splinertia::detail::SimdPack<T, N, Bytes>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = T;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};

// SPDX-License-Identifier: MIT
#include <splinertia/detail/simd_pack.hpp>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;

namespace {

/// The lanes of x, one by one.
template <typename T, int N, int Bytes>
std::vector<T> numbers(const SimdPack<T, N, Bytes>& x) {
  std::vector<T> v(N);
  x.store(v.data());
  return v;
}

}  // namespace

// One vector of the target, one and four of 16 bytes, and what the library uses.
TEMPLATE_TEST_CASE("lanes compute as their numbers do", "", (SimdPack<float, 4, 16>), (SimdPack<double, 2, 16>),
                   (SimdPack<double, 8, 16>), (SimdPack<float, 16, 16>), NativeSimdPack<float>,
                   NativeSimdPack<double>) {
  using L = TestType;
  using T = typename decltype(numbers(L(1)))::value_type;
  std::mt19937 bits(1);
  std::uniform_real_distribution<T> uniform(-10, 10);
  std::vector<T> a(L::size), b(L::size);
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] = uniform(bits);
    b[i] = uniform(bits);
  }
  const L x = L::load(a.data()), y = L::load(b.data());
  const auto sum = numbers(x + y), difference = numbers(x - y), product = numbers(x * y), quotient = numbers(x / y),
             negative = numbers(-x);
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(sum[i] == a[i] + b[i]);
    CHECK(difference[i] == a[i] - b[i]);
    CHECK(product[i] == a[i] * b[i]);
    CHECK(quotient[i] == a[i] / b[i]);
    CHECK(negative[i] == -a[i]);
  }
  L z = x;
  z += y;
  CHECK(numbers(z) == sum);
  z = x;
  z -= y;
  CHECK(numbers(z) == difference);
  z = x;
  z *= y;
  CHECK(numbers(z) == product);
  z = x;
  z /= y;
  CHECK(numbers(z) == quotient);
}

TEMPLATE_TEST_CASE("a number goes into all lanes, to the bit", "", float, double) {
  using L = NativeSimdPack<TestType>;
  const TestType tiny = std::numeric_limits<TestType>::denorm_min();
  for (const TestType value : {TestType(0), TestType(-0.0), TestType(1) / 3, -tiny, tiny}) {
    for (const TestType x : numbers(L(value))) {
      CHECK(x == value);
      CHECK(std::signbit(x) == std::signbit(value));
    }
  }
  CHECK(numbers(L(TestType(2)) * L::ramp()).back() == TestType(2 * (L::size - 1)));
}

TEST_CASE("lanes are cast number by number") {
  using Wide = SimdPack<double, NativeSimdPack<float>::size, vector_bytes>;
  using Narrow = NativeSimdPack<float>;
  const Wide x = Wide::ramp() / Wide(3.0);
  const auto wide = numbers(x), back = numbers(simd_pack_cast<double>(simd_pack_cast<float>(x)));
  const auto narrow = numbers(simd_pack_cast<float>(x));
  REQUIRE(narrow.size() == static_cast<std::size_t>(Narrow::size));
  for (std::size_t i = 0; i < wide.size(); ++i) {
    CHECK(narrow[i] == static_cast<float>(wide[i]));
    CHECK(back[i] == static_cast<double>(static_cast<float>(wide[i])));
  }
}

TEST_CASE("Eigen's small vectors hold lanes") {
  using L = NativeSimdPack<double>;
  const Eigen::Matrix<L, 3, 1> a(L(1.0), L(2.0), L(3.0)), b(L::ramp(), L(0.0), L(-1.0));
  const auto cross = numbers(Eigen::Matrix<L, 3, 1>(a.cross(b))[1]);  // a_z b_x − a_x b_z
  for (std::size_t i = 0; i < cross.size(); ++i) CHECK(cross[i] == 3 * static_cast<double>(i) + 1);
}

// SPDX-License-Identifier: MIT
#include <splinertia/detail/lanes.hpp>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;

namespace {

/// The lanes of x, one by one.
template <typename T, int N, int Bytes>
std::vector<T> numbers(const Lanes<T, N, Bytes>& x) {
  std::vector<T> v(N);
  x.store(v.data());
  return v;
}

}  // namespace

// One vector of the target, one and four of 16 bytes, and what the library uses.
TEMPLATE_TEST_CASE("lanes compute as their numbers do", "", (Lanes<float, 4, 16>), (Lanes<double, 2, 16>),
                   (Lanes<double, 8, 16>), (Lanes<float, 16, 16>), NativeLanes<float>, NativeLanes<double>) {
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
  using L = NativeLanes<TestType>;
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
  using Wide = Lanes<double, NativeLanes<float>::size, vector_bytes>;
  using Narrow = NativeLanes<float>;
  const Wide x = Wide::ramp() / Wide(3.0);
  const auto wide = numbers(x), back = numbers(lanes_cast<double>(lanes_cast<float>(x)));
  const auto narrow = numbers(lanes_cast<float>(x));
  REQUIRE(narrow.size() == static_cast<std::size_t>(Narrow::size));
  for (std::size_t i = 0; i < wide.size(); ++i) {
    CHECK(narrow[i] == static_cast<float>(wide[i]));
    CHECK(back[i] == static_cast<double>(static_cast<float>(wide[i])));
  }
}

TEST_CASE("Eigen's small vectors hold lanes") {
  using L = NativeLanes<double>;
  const Eigen::Matrix<L, 3, 1> a(L(1.0), L(2.0), L(3.0)), b(L::ramp(), L(0.0), L(-1.0));
  const auto cross = numbers(Eigen::Matrix<L, 3, 1>(a.cross(b))[1]);  // a_z b_x − a_x b_z
  for (std::size_t i = 0; i < cross.size(); ++i) CHECK(cross[i] == 3 * static_cast<double>(i) + 1);
}

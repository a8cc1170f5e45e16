#undef NDEBUG
// SPDX-License-Identifier: MIT
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <limits>
#include <splinertia/group/euclidean.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>
#include <string>

#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

/// What `work` prints before it aborts.
std::string last_words(const auto& work) {
  int ends[2];
  REQUIRE(::pipe(ends) == 0);
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGABRT, SIG_DFL);
    ::dup2(ends[1], STDERR_FILENO);
    work();
    ::_exit(0);
  }
  ::close(ends[1]);
  std::string text;
  char buffer[512];
  for (ssize_t count; (count = ::read(ends[0], buffer, sizeof buffer)) > 0;) {
    text.append(buffer, static_cast<std::size_t>(count));
  }
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  CHECK((WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT));
  return text;
}

template <typename K>
std::string words_of(const K& knots, typename K::Time t) {
  using Point = Eigen::Matrix<double, 1, 1>;
  const Spline<Point, 2, K> curve(knots, std::vector<Point>(3, Point(1.0)));
  const std::string text = last_words([&] { (void)curve.template evaluate<0>(t); });
  return text.substr(0, text.find('\n'));
}

}  // namespace

TEST_CASE("Where assertions are on, a time outside the domain ends the program and is named") {
  CHECK(words_of(UniformKnots{0.0, 0.25}, -0.5) == "splinertia: no curve at time -0.5, it is defined from 0 to 0.5");
  CHECK(words_of(NonUniformKnots<double>{{0, 0, 1, 2, 2}}, 2.5) ==
        "splinertia: no curve at time 2.5, it is defined from 0 to 2");
  CHECK(words_of(UniformKnots{nanoseconds{0}, nanoseconds{5}}, nanoseconds{11}) ==
        "splinertia: no curve at time 11, it is defined from 0 to 10");
  CHECK(words_of(UniformKnots{0.0F, 0.25F}, std::numeric_limits<float>::quiet_NaN()) ==
        "splinertia: no curve at time nan, it is defined from 0 to 0.5");
}

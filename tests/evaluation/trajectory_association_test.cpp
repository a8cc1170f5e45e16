// SPDX-License-Identifier: MIT
#include <chrono>
#include <limits>
#include <splinertia/evaluation/trajectory_association.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "io/temporary_directory.hpp"
#include "support/catch.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

namespace {

// Poses whose x tells which one it is.
template <typename G, typename Time>
std::vector<Stamped<G, Time>> poses_at(const std::vector<Time>& times) {
  std::vector<Stamped<G, Time>> poses;
  for (const Time time : times) {
    const auto x = static_cast<ScalarOf<G>>(poses.size());
    poses.push_back({time, make_pose<G>({}, Eigen::Vector3<ScalarOf<G>>(x, 0, 0))});
  }
  return poses;
}

auto in_seconds(const std::vector<double>& times) { return poses_at<SO3xR3<double>, double>(times); }

using Indices = std::vector<std::pair<int, int>>;

template <typename Pairs>
Indices indices(const Pairs& pairs) {
  Indices result;
  for (const auto& p : pairs) {
    result.emplace_back(static_cast<int>(position(p.reference).x()), static_cast<int>(position(p.estimate).x()));
  }
  return result;
}

std::string error_of(const auto& f) { return test::error_of<std::invalid_argument>(f); }

}  // namespace

TEST_CASE("Each pose of the shorter trajectory gets the nearest of the longer one") {
  const auto five = in_seconds({1.0, 2.0, 3.0, 4.0, 5.0}), three = in_seconds({0.995, 2.75, 4.0078125});
  CHECK(indices(associate(five, three)) == Indices{{0, 0}, {3, 2}});
  CHECK(indices(associate(three, five)) == Indices{{0, 0}, {2, 3}});
  CHECK(indices(associate(five, three, 0.25)) == Indices{{0, 0}, {2, 1}, {3, 2}});
  CHECK(indices(associate(five, three, 1e9)) == Indices{{0, 0}, {2, 1}, {3, 2}});
  // The time is that of the estimate.
  CHECK(associate(five, three).front().time == 0.995);
  CHECK(associate(three, five).front().time == 1.0);
}

TEST_CASE("The maximum difference is allowed, and of two at the same distance the earlier is taken") {
  const auto three = in_seconds({0.0, 1.0, 2.0}), two = in_seconds({0.5, 2.5});
  CHECK(indices(associate(three, two, 0.5)) == Indices{{0, 0}, {2, 1}});
  CHECK(indices(associate(three, three, 0)) == Indices{{0, 0}, {1, 1}, {2, 2}});
  const auto after = in_seconds({0.5, 2.5 + 1e-9});
  CHECK(indices(associate(three, after, 0.5)) == Indices{{0, 0}});
}

TEST_CASE("A pose of the longer trajectory can be the nearest of several, as in evo") {
  const auto three = in_seconds({0.0, 1.0, 10.0}), three_close = in_seconds({0.9, 1.0, 1.1});
  CHECK(indices(associate(three, three_close, 0.2)) == Indices{{1, 0}, {1, 1}, {1, 2}});
  CHECK(indices(associate(three_close, three, 0.2)) == Indices{{1, 1}});
}

TEST_CASE("Epoch stamps are compared as integers, for any pose and time") {
  const nanoseconds epoch{1403715524907143168};
  const auto a = poses_at<Sophus::SE3f, nanoseconds>({epoch, epoch + nanoseconds{100}});
  const auto b = poses_at<Sophus::SE3f, nanoseconds>({epoch + nanoseconds{10}, epoch + nanoseconds{111}});
  CHECK(indices(associate(a, b, 10e-9)) == Indices{{0, 0}});
  CHECK(indices(associate(a, b, 11e-9)) == Indices{{0, 0}, {1, 1}});
  CHECK(indices(associate(b, a, 11e-9)) == Indices{{0, 0}, {1, 1}});
}

TEST_CASE("Stamps further apart than integers count are not near") {
  constexpr nanoseconds low = nanoseconds::min(), high = nanoseconds::max(), few{5};
  const auto at = [](const std::vector<nanoseconds>& times) { return poses_at<SO3xR3<double>, nanoseconds>(times); };
  CHECK(indices(associate(at({low, high}), at({high - few}))) == Indices{{1, 0}});
  CHECK(indices(associate(at({low + few}), at({low, nanoseconds{0}, high}))) == Indices{{0, 0}});
  CHECK(
      error_of([&] { (void)associate(at({low}), at({high})); }) ==
      "associate: no pose of the estimate (9223372036854775807 to 9223372036854775807) is within 0.01 s of one of the "
      "reference (-9223372036854775808 to -9223372036854775808)");
}

TEST_CASE("What cannot be associated is refused") {
  const auto good = in_seconds({1, 2, 3});
  CHECK(error_of([&] { (void)associate(in_seconds({}), good); }) == "associate: the reference has no poses");
  CHECK(error_of([&] { (void)associate(good, in_seconds({})); }) == "associate: the estimate has no poses");
  CHECK(error_of([&] { (void)associate(good, in_seconds({1, 2, 2})); }) ==
        "associate: pose 2 of the estimate is at 2, expected increasing times");
  CHECK(error_of([&] { (void)associate(in_seconds({1, std::numeric_limits<double>::infinity()}), good); }) ==
        "associate: pose 1 of the reference is at inf, expected increasing times");
  auto bad = good;
  bad[1].value.get<1>().y() = std::numeric_limits<double>::quiet_NaN();
  CHECK(error_of([&] { (void)associate(good, bad); }) == "associate: pose 1 of the estimate is not finite");
  CHECK(error_of([&] { (void)associate(good, in_seconds({11, 12})); }) ==
        "associate: no pose of the estimate (11 to 12) is within 0.01 s of one of the reference (1 to 3)");
  CHECK(error_of([&] { (void)associate(good, good, -1); }) == "associate: maximum difference -1 s, expected >= 0 s");
  CHECK(error_of([&] { (void)associate(good, good, std::numeric_limits<double>::quiet_NaN()); }) ==
        "associate: maximum difference nan s, expected >= 0 s");
}

// SPDX-License-Identifier: MIT
#include <chrono>
#include <splinertia/group/euclidean.hpp>
#include <splinertia/spline/fit/detail/data_support.hpp>
#include <splinertia/spline/fit/detail/unmeasured_spans.hpp>
#include <splinertia/spline/nonuniform_knots.hpp>
#include <splinertia/spline/spline.hpp>
#include <vector>

#include "support/catch.hpp"

using namespace splinertia;
using namespace splinertia::detail;
using std::chrono::nanoseconds;

namespace {

using Number = Eigen::Matrix<double, 1, 1>;
using Line = Spline<Number, 4>;

/// A curve that is 0, of `length` s.
Line flat(double interval, double length) {
  const auto segments = static_cast<std::size_t>(length / interval + 0.5);
  return {{0, interval}, std::vector<Number>(segments + 3, Number(0))};
}

PosesOf<Line> poses_at(const std::vector<double>& times) {
  PosesOf<Line> poses;
  for (const double t : times) poses.push_back({t, Number(0)});
  return poses;
}

/// Times at a rate from 0 to 10 s, but those strictly within the holes.
std::vector<double> times_without(const std::vector<std::pair<double, double>>& holes, double rate = 100) {
  std::vector<double> times;
  for (int i = 0; i <= 10 * rate; ++i) {
    const double t = i / rate;
    bool inside = false;
    for (const auto& [from, to] : holes) inside = inside || (t > from + 1e-9 && t < to - 1e-9);
    if (!inside) times.push_back(t);
  }
  return times;
}

template <typename Curve>
std::vector<UnmeasuredSpan<typename Curve::Time>> spans_of(const Curve& curve, const PosesOf<Curve>& poses,
                                                           const auto& counts) {
  const auto undetermined =
      undetermined_control_points<Curve>(curve.knots(), curve.control_points().size(), poses, counts);
  return unmeasured_spans(curve, poses, counts, undetermined);
}

auto spans_of(const Line& curve, const std::vector<double>& times) {
  return spans_of(curve, poses_at(times), [](std::size_t) { return true; });
}

using Ends = std::vector<std::pair<double, double>>;

/// Where the gaps are.
Ends gaps_of(const auto& spans) {
  Ends gaps;
  for (const auto& span : spans) {
    if (span.is_gap) gaps.emplace_back(span.start, span.end);
  }
  return gaps;
}

}  // namespace

TEST_CASE("Poses all over leave no span") {
  CHECK(spans_of(flat(0.1, 10), times_without({})).empty());
  // One missing, and an interval of 2.5 times the usual, are no holes, however dense the knots.
  CHECK(gaps_of(spans_of(flat(0.02, 10), times_without({{4, 4.02}}))).empty());
  CHECK(gaps_of(spans_of(flat(0.01, 10), times_without({{4, 4.02}}))).empty());
}

TEST_CASE("A hole is told from its last pose to its next, at any phase") {
  const Line curve = flat(0.1, 10);
  for (int phase = 0; phase < 10; ++phase) {
    const double from = 4 + 0.01 * phase, to = from + 0.5;
    const auto spans = spans_of(curve, times_without({{from, to}}));
    REQUIRE(spans.size() == 1);
    CHECK(spans[0].is_gap);
    CHECK_THAT(spans[0].start, WithinAbs(from, 1e-12));
    CHECK_THAT(spans[0].end, WithinAbs(to, 1e-12));
    CHECK_THAT(spans[0].knot_interval, WithinRel(0.1, 1e-12));
  }
  // Longer than 1.5 knot intervals.
  CHECK(gaps_of(spans_of(curve, times_without({{4, 4.14}}))).empty());
  CHECK(gaps_of(spans_of(curve, times_without({{4, 4.16}}))).size() == 1);
}

TEST_CASE("Several holes, with a single pose between them, and at the ends") {
  const Line curve = flat(0.1, 10);
  CHECK(gaps_of(spans_of(curve, times_without({{2, 3}, {3, 4}, {4, 6}}))) == Ends{{2, 3}, {3, 4}, {4, 6}});
  // The curve reaches from 0 to 10 s, the poses do not.
  const auto inner = times_without({{-1, 1}, {8, 11}});
  CHECK(gaps_of(spans_of(curve, inner)) == Ends{{0, 1}, {8, curve.end()}});
  CHECK(gaps_of(spans_of(curve, {0, 10})) == Ends{{0, curve.end()}});
}

TEST_CASE("A pose that does not count is none") {
  const Line curve = flat(0.1, 10);
  const auto times = times_without({});
  const auto counts = [&](std::size_t i) { return !(times[i] > 4.005 && times[i] < 4.995); };
  CHECK(gaps_of(spans_of(curve, poses_at(times), counts)) == Ends{{4, 5}});
  CHECK(gaps_of(spans_of(curve, poses_at(times), [](std::size_t) { return false; })) == Ends{{0, curve.end()}});
}

TEST_CASE("Poses that are sparse all over leave spans, but no gaps") {
  const auto spans = spans_of(flat(0.1, 10), times_without({}, 5));  // a pose for two knots
  CHECK(spans.size() == 50);
  CHECK(gaps_of(spans).empty());
  // Sparse beside dense: between sparse ones there are gaps, as they are long beside the usual.
  std::vector<double> times = times_without({{5, 10}});
  times.pop_back();
  for (int i = 1; i <= 10; ++i) times.push_back(5 + 0.5 * i);
  CHECK(gaps_of(spans_of(flat(0.1, 10), times)).size() == 10);
}

TEST_CASE("Between uneven knots, and on integer time since an epoch") {
  using Curve = Spline<Number, 4, NonUniformKnots<nanoseconds>>;
  const nanoseconds epoch{1'403'715'524'907'143'168};
  const auto at = [&](double t) { return after(epoch, t); };
  // Dense to 4 s, one segment over the hole, dense from 6 s on.
  std::vector<nanoseconds> knots(3, at(0));
  for (int i = 0; i <= 40; ++i) knots.push_back(at(0.1 * i));
  for (int i = 0; i <= 40; ++i) knots.push_back(at(6 + 0.1 * i));
  knots.insert(knots.end(), 3, at(10));
  const Curve curve({knots}, std::vector<Number>(knots.size() - 4, Number(0)));
  PosesOf<Curve> poses;
  for (const double t : times_without({{4, 6}})) poses.push_back({at(t), Number(0)});
  const auto spans = spans_of(curve, poses, [](std::size_t) { return true; });
  REQUIRE(spans.size() == 1);
  CHECK(spans[0].is_gap);
  CHECK(spans[0].start == at(4));
  CHECK(spans[0].end == at(6));
  CHECK_THAT(spans[0].knot_interval, WithinAbs(0.1, 1e-6));
}

TEST_CASE("What is measured is what is left, one part more than spans") {
  const Line curve = flat(0.1, 10);
  const auto none = measured_parts(curve, {});
  REQUIRE(none.size() == 1);
  CHECK(none[0].start == 0);
  CHECK_THAT(none[0].end, WithinAbs(10, 1e-12));
  const auto parts = measured_parts(curve, spans_of(curve, times_without({{2, 3}, {3, 4}, {6, 7}, {9, 11}})));
  REQUIRE(parts.size() == 5);
  const std::vector<std::pair<double, double>> expected{{0, 2}, {3, 3}, {4, 6}, {7, 9}, {curve.end(), curve.end()}};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    CHECK_THAT(parts[i].start, WithinAbs(expected[i].first, 1e-12));
    CHECK_THAT(parts[i].end, WithinAbs(expected[i].second, 1e-12));
  }
}

TEST_CASE("Stretches of at most as many poses as the order belong to the gaps beside them") {
  const Line curve = flat(0.1, 10);
  const auto reported = [&](const std::vector<double>& times) {
    const auto poses = poses_at(times);
    const auto all = [](std::size_t) { return true; };
    Ends ends;
    for (const auto& gap : reported_gaps(curve, poses, all, spans_of(curve, poses, all))) {
      ends.push_back({gap.start, gap.end});
    }
    return ends;
  };
  // A pose every 0.01 s. Three, then five between gaps.
  CHECK(reported(times_without({{2, 3}, {3.02, 4}, {4.04, 6}})) == Ends{{2, 4}, {4.04, 6}});
  CHECK(reported(times_without({{0.03, 3}, {5, 9.97}})) == Ends{{0, 3}, {5, curve.end()}});
  CHECK(reported(times_without({{0.04, 3}, {5, 9.96}})) == Ends{{0.04, 3}, {5, 9.96}});
  CHECK(reported(times_without({})).empty());
}

// SPDX-License-Identifier: MIT
/// Decides how the rows of a trajectory file are read: by the user's options, by its header, or by its shape.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <splinertia/detail/message.hpp>
#include <splinertia/group/sophus.hpp>
#include <splinertia/io/detail/trajectory_columns.hpp>
#include <splinertia/io/detail/trajectory_head.hpp>
#include <splinertia/io/detail/trajectory_header.hpp>
#include <splinertia/io/detail/trajectory_stamps.hpp>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/text_file.hpp>
#include <splinertia/io/trajectory_format.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace splinertia::detail {

[[nodiscard]] inline const KnownTrajectoryFormat& known_format(TrajectoryFormat::Kind kind) {
  return *std::find_if(known_trajectory_formats.begin(), known_trajectory_formats.end(),
                       [kind](const KnownTrajectoryFormat& known) { return known.kind == kind; });
}

/// The unit of stamps is the first of these that is known:
///   1. the given one
///   2. that named by the header
///   3. that in which the stamps count from 1970, if the rate is plausible for poses
///   4. the usual one of the format; if the stamps count from 1970, only if the rate is plausible
///   5. seconds, if the stamps have decimals and neither count from 1970 nor have a usual unit
/// Otherwise throws std::runtime_error, whose message begins with `where`.
[[nodiscard]] inline TimeUnit choose_time_unit(const StampSample& stamps, std::optional<TimeUnit> given,
                                               std::optional<TimeUnit> named, std::optional<TimeUnit> usual,
                                               std::string_view where, std::vector<std::string>& notes) {
  if (given) return *given;
  if (named) return *named;
  const auto since_1970 = stamps.since_1970();
  if (since_1970 && is_plausible(stamps.step, *since_1970)) {
    const bool plain_seconds = since_1970 == TimeUnit::seconds && stamps.decimals;
    if (since_1970 != usual && !plain_seconds) {
      notes.push_back(message("stamps of ", 10 + static_cast<int>(*since_1970), " digits are taken as ",
                              time_unit_name(*since_1970), " since 1970 (--time-unit)"));
    }
    return *since_1970;
  }
  if (usual && (!since_1970 || is_plausible(stamps.step, *usual))) return *usual;
  if (!usual && !since_1970 && stamps.decimals) {
    notes.push_back("stamps with decimals are taken as seconds (--time-unit)");
    return TimeUnit::seconds;
  }
  throw std::runtime_error(message(where, "the unit of the stamps is unknown",
                                   stamps.step > 0 ? ": the poses would have " + rates_text(stamps.step) : "",
                                   "; give --time-unit s, ms, us or ns"));
}

/// How rows are read.
struct TrajectoryLayout {
  ColumnPlan plan;
  TimeUnit unit = TimeUnit::nanoseconds;
  bool unit_given = false;  // by the user: not checked against the rate
  std::vector<std::string> notes{};
};

/// Chooses the layout of one file.
class LayoutChoice {
 public:
  LayoutChoice(const TextFile& file, const TrajectoryHead& head, const TrajectoryFormat& format)
      : file_(file), head_(head), format_(format) {}

  [[nodiscard]] TrajectoryLayout choose() {
    using Kind = TrajectoryFormat::Kind;
    if (!format_.columns.empty()) {
      if (format_.kind != Kind::automatic) {
        throw std::invalid_argument(
            "--columns: the format fixes the columns, expected --columns or --format, not both");
      }
      layout_.plan = parse_columns(format_.columns);
      require_columns("--columns " + layout_.plan.text());
    } else if (format_.kind != Kind::automatic) {
      take(known_format(format_.kind));
    } else if (head_.header) {
      take_header();
    } else {
      recognize();
    }
    choose_unit();
    format_.quaternion_order ? set_order(*format_.quaternion_order) : assume_order();
    return std::move(layout_);
  }

 private:
  template <typename... Parts>
  [[noreturn]] void fail(const Parts&... what) const {
    throw std::runtime_error(message(file_.path(), ':', head_.rows.front().number, ": ", what...));
  }

  /// Throws std::runtime_error unless there are as many columns as planned, or more if the plan allows it.
  void require_columns(const std::string& title) const {
    const std::size_t planned = layout_.plan.places.size();
    if (head_.columns == planned || (layout_.plan.more && head_.columns > planned)) return;
    fail(head_.columns, head_.columns == 1 ? " column" : " columns", ", expected ", planned,
         layout_.plan.more ? " or more" : "", " of ", title);
  }

  void take(const KnownTrajectoryFormat& known) {
    layout_.plan = parse_columns(known.columns);
    if (head_.columns == known.fewest_columns) layout_.plan.places.resize(known.fewest_columns);
    require_columns(message(known.title, ": ", known.columns));
    usual_ = known.unit;
    if (!known.remark.empty()) layout_.notes.emplace_back(known.remark);
  }

  void take_header() {
    const Header& header = *head_.header;
    layout_.plan = header.plan;
    const std::string names = message("the names in line ", head_.header_line);
    if (head_.columns < layout_.plan.places.size()) {  // OpenVINS names covariances that are not there
      layout_.plan.places.resize(head_.columns);
      if (!layout_.plan.has_pose()) layout_.plan = header.plan;
      layout_.plan.drop_incomplete_vectors();
    }
    require_columns(names + " (--columns)");
    layout_.notes.push_back(message("columns are ", layout_.plan.text(), " according to ", names));
    named_ = header.unit;
    if (header.asl) usual_ = TimeUnit::nanoseconds;
  }

  /// By shape: the number of columns, their separators, the stamps, and where there are unit quaternions.
  void recognize() {
    using Kind = TrajectoryFormat::Kind;
    if (head_.unclear_header) {
      throw std::runtime_error(
          message(file_.path(), ':', head_.unclear_header->number, ": ", excerpt(head_.unclear_header->text, 80),
                  " does not name the columns of poses such as t,x,y,z,qx,qy,qz,qw; give --columns"));
    }
    const StampSample stamps(head_.texts(0));
    const bool whole = !stamps.decimals || stamps.since_1970() == TimeUnit::nanoseconds;
    if (head_.columns == 8) {
      layout_.plan = parse_columns(known_format(Kind::tum).columns);
      order_unknown_ = true;
    } else if (head_.columns == 12) {
      assume(Kind::kitti);
    } else if (head_.columns == 17 && whole && head_.has_unit_quaternion(4)) {
      assume(Kind::euroc);
    } else if (head_.columns == 11 && head_.trailing_comma && whole) {
      assume(Kind::vins);
    } else if (head_.columns >= 17 && !whole && !head_.commas && head_.has_unit_quaternion(1)) {
      assume(Kind::openvins);
    } else {
      std::string names;
      for (const KnownTrajectoryFormat& known : known_trajectory_formats) {
        names += message(names.empty() ? "" : ", ", known.name);
      }
      fail(head_.columns, head_.columns == 1 ? " column" : " columns",
           " without names: not a known trajectory format; give --columns, or --format (", names, ')');
    }
  }

  void assume(TrajectoryFormat::Kind kind) {
    const KnownTrajectoryFormat& known = known_format(kind);
    take(known);
    layout_.notes.push_back(message("no header names the columns: ", known.title, " assumed, ", layout_.plan.text()));
  }

  void choose_unit() {
    const bool stamps = layout_.plan.has(column::time), rate = format_.rate.has_value(), times = !format_.times.empty();
    if (rate && !(*format_.rate > 0 && *format_.rate <= 1e9)) {
      throw std::invalid_argument(
          message("--pose-rate: ", *format_.rate, ", expected a positive number of Hz, up to 1e9"));
    }
    if (static_cast<int>(stamps) + static_cast<int>(rate) + static_cast<int>(times) != 1) {
      if (!stamps && !rate) fail("the rows have no stamps (", layout_.plan.text(), "); give --pose-rate or --times");
      if (!stamps) throw std::invalid_argument("--pose-rate and --times: expected only one of them");
      throw std::invalid_argument(message(rate ? "--pose-rate" : "--times", ": ", file_.path(),
                                          " has stamps of its own, expected a file without"));
    }
    if (rate && format_.time_unit) {
      throw std::invalid_argument("--time-unit and --pose-rate: the file has no stamps, expected --pose-rate only");
    }
    if (!stamps) return;
    const auto place = std::find(layout_.plan.places.begin(), layout_.plan.places.end(), column::time);
    const StampSample sample(head_.texts(static_cast<std::size_t>(place - layout_.plan.places.begin())));
    layout_.unit_given = format_.time_unit.has_value();
    layout_.unit = choose_time_unit(sample, format_.time_unit, named_, usual_,
                                    message(file_.path(), ':', head_.rows.front().number, ": "), layout_.notes);
  }

  void set_order(QuaternionOrder order) {
    if (!layout_.plan.has(column::quaternion, 4)) {
      throw std::invalid_argument(message("--quaternion-order: ", file_.path(), " has no quaternions, expected some"));
    }
    const ColumnPlan before = layout_.plan;
    layout_.plan.set_order(order);
    if (order_unknown_) {
      layout_.notes.push_back(message("no header names the columns: ", layout_.plan.text(), " assumed"));
    } else if (layout_.plan.places != before.places) {
      if (!format_.columns.empty()) {
        throw std::invalid_argument("--quaternion-order: --columns gives another order, expected only one of them");
      }
      layout_.notes.push_back(message("--quaternion-order is used, although ", before.text(), " was expected"));
    }
  }

  /// For 8 columns without names: with blanks, and stamps not in ns, it is a TUM trajectory. With commas or stamps in
  /// ns both orders are in use: w first by EuRoC and VINS, w last by rpg and ICE-BA.
  void assume_order() {
    if (!order_unknown_) return;
    if (!head_.commas && layout_.unit != TimeUnit::nanoseconds) {
      layout_.notes.push_back(message("no header names the columns: a TUM trajectory assumed, ", layout_.plan.text(),
                                      " (--quaternion-order)"));
      return;
    }
    std::string taken;
    for (const std::string& note : layout_.notes) taken += "; " + note;
    const auto turn = [&](QuaternionOrder order) {
      ColumnPlan plan = layout_.plan;
      plan.set_order(order);
      return turn_text(plan);
    };
    fail("the order of the quaternion is unknown, both are in use: the first attitude is a rotation of ",
         turn(QuaternionOrder::wxyz), " with w first and of ", turn(QuaternionOrder::xyzw),
         " with w last; give --quaternion-order wxyz or xyzw", taken);
  }

  /// "17.2 deg about 0 1 0": the attitude in the first row.
  [[nodiscard]] std::string turn_text(const ColumnPlan& plan) const {
    std::array<double, 4> xyzw{};
    for (std::size_t i = 0; i < plan.places.size(); ++i) {
      const std::size_t place = plan.places[i] - column::quaternion;
      if (place < 4) xyzw[place] = parse_real(head_.typical_rows.front()[i]).value;
    }
    const Eigen::AngleAxisd turn(Eigen::Quaterniond(xyzw[3], xyzw[0], xyzw[1], xyzw[2]).normalized());
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%.4g deg about (%.3g %.3g %.3g)", turn.angle() * 57.29577951308232,
                  turn.axis().x(), turn.axis().y(), turn.axis().z());
    return text.data();
  }

  const TextFile& file_;
  const TrajectoryHead& head_;
  const TrajectoryFormat& format_;
  TrajectoryLayout layout_{};
  std::optional<TimeUnit> named_{}, usual_{};  // of the header, of the format
  bool order_unknown_ = false;
};

}  // namespace splinertia::detail

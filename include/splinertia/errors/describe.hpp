// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdlib>
#include <splinertia/detail/message.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <splinertia/errors/sensor_kind.hpp>
#include <string>
#include <string_view>
#include <tuple>

namespace splinertia {

/// The unit of what a sensor measures: unit/s^per_seconds. {"m"} of a barometer, {"m", 1} of a wheel's speed, {"px"} of a
/// camera.
struct MeasuredUnit {
  std::string_view unit;
  int per_seconds = 0;

  constexpr MeasuredUnit(std::string_view unit_, int per_seconds_ = 0) : unit(unit_), per_seconds(per_seconds_) {}
  constexpr MeasuredUnit(const char* unit_, int per_seconds_ = 0) : unit(unit_), per_seconds(per_seconds_) {}
  constexpr MeasuredUnit(SensorKind kind)
      : unit(kind == SensorKind::accel ? "m" : "rad"), per_seconds(kind == SensorKind::accel ? 2 : 1) {}
};

/// A unit as text: "rad/s^2/sqrt(Hz)".
[[nodiscard]] inline std::string unit_text(std::string_view unit, const MeasuredUnit&) { return std::string(unit); }
[[nodiscard]] inline std::string unit_text(const SensorUnit& unit, const MeasuredUnit& measured) {
  const int seconds = unit.per_seconds + measured.per_seconds;
  std::string text(measured.unit);
  if (seconds != 0) text += seconds > 0 ? "/s" : "*s";
  if (std::abs(seconds) >= 2) text += detail::message('^', std::abs(seconds));
  if (unit.per_root_hertz) text += "/sqrt(Hz)";
  if (unit.per_kelvin) text += "/K";
  return unit.reciprocal ? "1/(" + text + ')' : text;
}

namespace detail {

/// A value as text: one number if all axes have the same, matrices row by row.
template <typename Value>
[[nodiscard]] std::string value_text(const Value& value) {
  return message(value);
}
template <typename Scalar, int N>
[[nodiscard]] std::string value_text(const PerAxis<Scalar, N>& value) {
  if (std::all_of(value.begin(), value.end(), [&](const Scalar& x) { return x == value[0]; })) return message(value[0]);
  std::string text;
  for (const Scalar& x : value) text += (text.empty() ? "(" : " ") + message(x);
  return text + ')';
}
template <typename Scalar, int Rows, int Columns>
[[nodiscard]] std::string value_text(const Eigen::Matrix<Scalar, Rows, Columns>& m) {
  std::string text;
  for (int row = 0; row < Rows; ++row) {
    for (int column = 0; column < Columns; ++column)
      text += (column > 0 ? " " : row > 0 ? "; " : "(") + message(m(row, column));
  }
  return text + ')';
}

}  // namespace detail

/// A term, its parameters and their units in one line: describe(WhiteNoise{0.015}, SensorKind::gyro) is "white noise:
/// density 0.015 rad/s/sqrt(Hz)".
template <ErrorTerm Term>
[[nodiscard]] std::string describe(const Term& term, const MeasuredUnit& measured) {
  std::string text;
  if constexpr (requires { Term::name; }) {
    text = Term::name;
  } else {
    text = "unnamed term";
  }
  std::string separator = ": ";
  const auto parameter = [&](const char* name, const auto& value, const auto& unit) {
    text += detail::message(separator, name, ' ', detail::value_text(value));
    if (const std::string in = unit_text(unit, measured); !in.empty() && in != "1") text += ' ' + in;
    separator = ", ";
  };
  if constexpr (requires { term.describe(parameter); }) term.describe(parameter);
  return text;
}

/// The terms of a model in their order, one line each; "ideal" if there are none:
///
///   describe(gyro, SensorKind::gyro)   describe(barometer, "m")   describe(wheel, {"m", 1})
template <typename... Terms>
[[nodiscard]] std::string describe(const ErrorModel<Terms...>& model, const MeasuredUnit& measured) {
  if (sizeof...(Terms) == 0) return "ideal\n";
  return std::apply([&](const auto&... term) { return (std::string() + ... + (describe(term, measured) + '\n')); },
                    model.terms());
}

}  // namespace splinertia

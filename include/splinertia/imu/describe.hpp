// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <splinertia/detail/message.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/per_axis.hpp>
#include <splinertia/imu/imu.hpp>
#include <string>
#include <string_view>
#include <tuple>

namespace splinertia {

/// What an error model belongs to, which decides its units.
enum class SensorKind { gyro, accel, clock };

/// A unit as text: "rad/s^2/sqrt(Hz)".
[[nodiscard]] inline std::string unit_text(std::string_view unit, SensorKind) { return std::string(unit); }
[[nodiscard]] inline std::string unit_text(const SensorUnit& unit, SensorKind kind) {
  const int seconds = unit.per_seconds + (kind == SensorKind::accel ? 2 : 1);
  std::string text = kind == SensorKind::accel ? "m" : "rad";
  if (seconds >= 1) text += "/s";
  if (seconds >= 2) text += message('^', seconds);
  if (unit.per_root_hertz) text += "/sqrt(Hz)";
  if (unit.per_kelvin) text += "/K";
  return text;
}

/// A value as text: one number if all axes have the same, matrices row by row.
template <typename Value>
[[nodiscard]] std::string value_text(const Value& value) {
  return message(value);
}
template <typename Scalar>
[[nodiscard]] std::string value_text(const PerAxis<Scalar>& value) {
  if (value[0] == value[1] && value[1] == value[2]) return message(value[0]);
  return message('(', value[0], ' ', value[1], ' ', value[2], ')');
}
template <typename Scalar>
[[nodiscard]] std::string value_text(const Matrix3<Scalar>& m) {
  const auto row = [&](int i) { return message(m(i, 0), ' ', m(i, 1), ' ', m(i, 2)); };
  return message('(', row(0), "; ", row(1), "; ", row(2), ')');
}

/// A term, its parameters and their units in one line: "white noise: density 0.015 rad/s/sqrt(Hz)".
template <ErrorTerm Term>
[[nodiscard]] std::string describe(const Term& term, SensorKind kind) {
  std::string text;
  if constexpr (requires { Term::name; }) {
    text = Term::name;
  } else {
    text = "unnamed term";
  }
  std::string separator = ": ";
  const auto parameter = [&](const char* name, const auto& value, const auto& unit) {
    text += message(separator, name, ' ', value_text(value));
    if (const std::string in = unit_text(unit, kind); !in.empty() && in != "1") text += ' ' + in;
    separator = ", ";
  };
  if constexpr (requires { term.describe(parameter); }) term.describe(parameter);
  return text;
}

/// The terms of a model in their order, one line each; "ideal" if there are none.
template <typename... Terms>
[[nodiscard]] std::string describe(const ErrorModel<Terms...>& model, SensorKind kind) {
  if (sizeof...(Terms) == 0) return "ideal\n";
  return std::apply([&](const auto&... term) { return (std::string() + ... + (describe(term, kind) + '\n')); },
                    model.terms());
}

/// All errors of an IMU, one line per term.
template <typename Gyro, typename Accel, typename Stamps>
[[nodiscard]] std::string describe(const Imu<Gyro, Accel, Stamps>& imu) {
  const auto indented = [](const char* title, std::string lines) {
    std::string text = title;
    text += ":\n";
    while (!lines.empty()) {
      const std::size_t end = lines.find('\n') + 1;
      text += "  " + lines.substr(0, end);
      lines.erase(0, end);
    }
    return text;
  };
  return indented("gyro", describe(imu.gyro, SensorKind::gyro)) +
         indented("accel", describe(imu.accel, SensorKind::accel)) +
         indented("stamps", describe(imu.stamps, SensorKind::clock));
}

}  // namespace splinertia

// SPDX-License-Identifier: MIT
/// Sensor errors by hand: loops over samples, and the errors. An Error is made from the key of its sensor.
#pragma once

#include <cmath>
#include <memory>
#include <splinertia/splinertia.hpp>

#include "workload.hpp"

namespace {

template <typename Error>
[[gnu::noinline]] void apply_by_hand(std::size_t calls, Sums& result) {
  Error error(run_key / "gyro");
  const Vector* measurements = workload().measurements.data();
  Vector sum = Vector::Zero();
  for (std::size_t i = 0; i < calls; ++i) sum += error(measurements[i % 4096]);
  result.gyro += sum;
}

template <typename Error>
[[gnu::noinline]] void simulate_by_hand(std::size_t calls, Sums& result) {
  const Curve& motion = curve();
  const double hz = rate(), start = motion.start(), end = (static_cast<double>(calls) - 0.5) / hz;
  const Vector gravity = standard_gravity<double>();
  Error gyro(run_key / "gyro"), accel(run_key / "accel");
  Sums sums;
  for (std::size_t i = 0; i < calls; ++i) {
    double t = start + static_cast<double>(i) / hz;
    if (!(t < end)) t = end;
    const auto ideal = ideal_imu(motion.evaluate<2>(t), gravity);
    sums.gyro += gyro(ideal.gyro);
    sums.accel += accel(ideal.accel);
  }
  result.gyro += sums.gyro;
  result.accel += sums.accel;
}

struct Normals {
  NormalStream<> x, y, z;

  explicit Normals(StreamKey term) : x(term / 0), y(term / 1), z(term / 2) {}
  [[gnu::always_inline]] Vector operator()() {
    const double a = x(), b = y(), c = z();
    return {a, b, c};
  }
};

struct NoErrorsByHand {
  explicit NoErrorsByHand(StreamKey) {}
  [[gnu::always_inline]] Vector operator()(const Vector& v) { return v; }
};

constexpr double density = 0.015;

struct WhiteNoiseByHand {
  Normals normals;
  double deviation = density * (1 / std::sqrt(1 / rate()));

  explicit WhiteNoiseByHand(StreamKey sensor) : normals(sensor / "white noise" / 0) {}
  [[gnu::always_inline]] Vector operator()(const Vector& v) { return v + deviation * normals(); }
};

struct RandomWalkByHand {
  Normals normals;
  double step = density * std::sqrt(1 / rate());
  Vector bias = Vector::Zero();

  explicit RandomWalkByHand(StreamKey sensor) : normals(sensor / "random walk" / 0) {}
  [[gnu::always_inline]] Vector operator()(const Vector& v) {
    const Vector result = v + bias;
    bias += step * normals();
    return result;
  }
};

struct WhiteNoiseRandomWalkByHand {
  WhiteNoiseByHand white;
  RandomWalkByHand walk;

  explicit WhiteNoiseRandomWalkByHand(StreamKey sensor) : white(sensor), walk(sensor) {}
  [[gnu::always_inline]] Vector operator()(const Vector& v) { return walk(white(v)); }
};

constexpr double deviation = 0.1, correlation_time = 100;

struct GaussMarkovByHand {
  Normals normals;
  double forget, step;
  Vector bias;

  explicit GaussMarkovByHand(StreamKey sensor) : normals(sensor / "Gauss-Markov" / 0) {
    const double h = 1 / rate() / correlation_time;
    forget = -std::expm1(-h);
    step = deviation * std::sqrt(-std::expm1(-2 * h));
    bias = deviation * normals();
  }
  [[gnu::always_inline]] Vector operator()(const Vector& v) {
    const Vector result = v + bias;
    bias += step * normals() - forget * bias;
    return result;
  }
};

/// A vector that is unknown while compiling.
Vector opaque(double x, double y, double z) { return Vector(x, y, z) * (rate() / 200); }

struct ConstantBiasByHand {
  Vector bias = opaque(0.1, 0.2, 0.3);

  explicit ConstantBiasByHand(StreamKey) {}
  [[gnu::always_inline]] Vector operator()(const Vector& v) { return v + bias; }
};

Eigen::Matrix3d misalignment() {
  return (Eigen::Matrix3d() << opaque(1.01, 0.02, 0.03), opaque(0, 0.99, 0.01), opaque(0.04, 0, 1.02)).finished();
}

struct MisalignmentByHand {
  Eigen::Matrix3d matrix = misalignment();

  explicit MisalignmentByHand(StreamKey) {}
  [[gnu::always_inline]] Vector operator()(const Vector& v) { return matrix * v; }
};

struct SaturationByHand {
  Vector limit = opaque(1.5, 2, 2.5);

  explicit SaturationByHand(StreamKey) {}
  [[gnu::always_inline]] Vector operator()(const Vector& v) {
    return {std::clamp(v.x(), -limit.x(), limit.x()), std::clamp(v.y(), -limit.y(), limit.y()),
            std::clamp(v.z(), -limit.z(), limit.z())};
  }
};

}  // namespace

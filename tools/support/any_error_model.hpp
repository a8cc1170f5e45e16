// SPDX-License-Identifier: MIT
// Error models whose terms are known only at run time, from a file or the command line. Each term costs a virtual call,
// which ErrorModel<Terms...> avoids; the samples are the same to the bit.
#pragma once

#include <algorithm>
#include <concepts>
#include <map>
#include <memory>
#include <splinertia/errors/clock/stamp.hpp>
#include <splinertia/errors/error_model.hpp>
#include <splinertia/errors/output/saturation.hpp>
#include <splinertia/imu/describe.hpp>
#include <splinertia/imu/imu_sensor_sample.hpp>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

/// Error terms in the order in which they apply to an AnySample: ImuSensorSample<double> of a sensor or Stamp<double> of
/// a clock. An Imu can use it in place of an ErrorModel.
template <typename AnySample>
class AnyErrorModel {
  struct RunningTerm {
    virtual ~RunningTerm() = default;
    virtual void apply(AnySample& sample) = 0;
  };
  struct Term {
    virtual ~Term() = default;
    virtual std::string_view name() const = 0;
    virtual std::unique_ptr<RunningTerm> start(splinertia::StreamKey key) const = 0;
    virtual std::string describe(splinertia::SensorKind kind) const = 0;
  };

 public:
  /// What changes from sample to sample, for one sensor in one run.
  using State = std::vector<std::unique_ptr<RunningTerm>>;

  AnyErrorModel() = default;
  template <typename... Terms>
  explicit AnyErrorModel(const splinertia::ErrorModel<Terms...>& model) {
    std::apply([&](const auto&... term) { (add(term), ...); }, model.terms());
  }

  /// Appends a term. Throws std::invalid_argument if it is incompatible with one of the others.
  template <splinertia::ErrorTerm T>
  void add(const T& term) {
    check_beside<splinertia::Saturation<double, 1>, splinertia::Saturation<double, 3>>(term);
    check_beside<splinertia::Quantization<double, 1>, splinertia::Quantization<double, 3>>(term);
    terms_.push_back(std::make_shared<const Held<T>>(term));
  }

  /// Replaces the first term of the same name and removes the others of that name. Appends the term if there are none.
  template <splinertia::ErrorTerm T>
  void replace(const T& term) {
    const auto is_one = [](const auto& other) { return other->name() == T::name; };
    const auto first = std::find_if(terms_.begin(), terms_.end(), is_one);
    if (first == terms_.end()) return add(term);
    *first = std::make_shared<const Held<T>>(term);
    terms_.erase(std::remove_if(first + 1, terms_.end(), is_one), terms_.end());
  }

  template <int Axes = AnySample::axes, splinertia::BitGenerator Generator = splinertia::Xoshiro256>
    requires(Axes == AnySample::axes && std::same_as<Generator, splinertia::Xoshiro256>)
  [[nodiscard]] State start(splinertia::StreamKey sensor) const {
    State state;
    std::map<std::string_view, std::uint64_t> occurrences;
    for (const auto& term : terms_) {
      state.push_back(term->start(sensor / term->name() / occurrences[term->name()]++));
    }
    return state;
  }

  void apply(AnySample& sample, State& state) const {
    for (const auto& term : state) term->apply(sample);
  }

  /// All terms of type T.
  template <typename T>
  [[nodiscard]] std::vector<T> all() const {
    std::vector<T> found;
    for (const auto& term : terms_) {
      if (const auto* held = dynamic_cast<const Held<T>*>(term.get())) found.push_back(held->term);
    }
    return found;
  }

  /// The terms in their order, one line each; "ideal" if there are none.
  [[nodiscard]] std::string describe(splinertia::SensorKind kind) const {
    std::string text;
    for (const auto& term : terms_) text += term->describe(kind) + '\n';
    return text.empty() ? "ideal\n" : text;
  }

 private:
  template <typename... Others>
  void check_beside(const auto& term) const {
    (check_beside_one<Others>(term), ...);
  }
  template <typename Other>
  void check_beside_one(const auto& term) const {
    if constexpr (requires(const Other& other) { check_together(term, other); }) {
      for (const Other& other : all<Other>()) check_together(term, other);
    }
    if constexpr (requires(const Other& other) { check_together(other, term); }) {
      for (const Other& other : all<Other>()) check_together(other, term);
    }
  }

  template <typename T>
  struct Running final : RunningTerm {
    T term;
    splinertia::StateOf<T, AnySample::axes> state;

    template <typename... Key>
    explicit Running(const T& term_, const Key&... key) : term(term_), state(key...) {}
    void apply(AnySample& sample) override { term.apply(sample, state); }
  };

  template <typename T>
  struct Held final : Term {
    T term;

    explicit Held(const T& term_) : term(term_) {}
    std::string_view name() const override { return T::name; }
    std::unique_ptr<RunningTerm> start(splinertia::StreamKey key) const override {
      if constexpr (splinertia::StochasticTerm<T>) {
        return std::make_unique<Running<T>>(term, key);
      } else {
        return std::make_unique<Running<T>>(term);
      }
    }
    std::string describe(splinertia::SensorKind kind) const override { return splinertia::describe(term, kind); }
  };

  std::vector<std::shared_ptr<const Term>> terms_;
};

template <typename AnySample>
[[nodiscard]] std::string describe(const AnyErrorModel<AnySample>& model, splinertia::SensorKind kind) {
  return model.describe(kind);
}

using AnySensorModel = AnyErrorModel<splinertia::ImuSensorSample<double>>;
using AnyStampModel = AnyErrorModel<splinertia::Stamp<double>>;
using AnyImu = splinertia::Imu<AnySensorModel, AnySensorModel, AnyStampModel>;

/// The same errors, term by term.
template <typename Gyro, typename Accel, typename Stamps>
[[nodiscard]] AnyImu any_imu(const splinertia::Imu<Gyro, Accel, Stamps>& imu) {
  return {AnySensorModel(imu.gyro), AnySensorModel(imu.accel), AnyStampModel(imu.stamps)};
}

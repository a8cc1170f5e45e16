// SPDX-License-Identifier: MIT
#include "support/error_yaml.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <splinertia/splinertia.hpp>
#include <stdexcept>
#include <vector>

#include "support/concat.hpp"
#include "support/yaml_reader.hpp"

using namespace splinertia;

namespace {

/// The parameters of one term: a single value for the first parameter, or a map of `name: value`.
class Parameters {
 public:
  explicit Parameters(YamlReader reader) : reader_(std::move(reader)) {}

  [[nodiscard]] bool has(const std::string& name) {
    asked_.insert(name);
    return reader_.is_map() && reader_.has(name);
  }
  [[nodiscard]] YamlReader operator[](const std::string& name) {
    asked_.insert(name);
    if (reader_.is_map()) return reader_[name];
    if (taken_++ > 0) reader_.fail(concat("no ", name, ", expected a map of parameters, {", name, ": ..., ...}"));
    return reader_;
  }
  [[nodiscard]] PerAxis<double> per_axis(const std::string& name) { return (*this)[name].per_axis(); }
  [[nodiscard]] double number(const std::string& name) { return (*this)[name].number(); }
  [[nodiscard]] double number(const std::string& name, double otherwise) {
    return has(name) ? reader_[name].number() : otherwise;
  }
  [[nodiscard]] PerAxis<double> per_axis(const std::string& name, double otherwise) {
    return has(name) ? reader_[name].per_axis() : PerAxis<double>(otherwise);
  }
  void expect_no_more() const {
    if (reader_.is_map()) reader_.expect_only(asked_);
  }

 private:
  YamlReader reader_;
  std::set<std::string> asked_;
  int taken_ = 0;
};

WarmUp<double> warm_up(Parameters& p) {
  const double initial = p.number("initial_temperature");
  return {initial, p.number("final_temperature", initial), p.number("time_constant", 1)};
}

Misalignment<double> misalignment(Parameters& p) {
  if (p.has("percent")) return misalignment_from_percent(p["percent"].matrix());
  return p["matrix"].matrix();
}

GaussMarkov<double, 3> gauss_markov(Parameters& p) {
  const auto deviation = p.per_axis("standard_deviation"), time = p.per_axis("correlation_time");
  if (p.has("initial_value")) return {deviation, time, p.per_axis("initial_value")};
  return {deviation, time};
}

BiasInstability<double, 7, 3> bias_instability(Parameters& p) {
  FlickerBand<double> band;
  const auto coefficient = [&]() -> PerAxis<double> {
    if (!p.has("floor")) return p.per_axis("coefficient");
    const auto floor = p.per_axis("floor");
    return {bias_instability_from_floor(floor[0]), bias_instability_from_floor(floor[1]),
            bias_instability_from_floor(floor[2])};
  }();
  band.shortest = p.number("shortest", band.shortest);
  band.longest = p.number("longest", band.longest);
  return {coefficient, band};
}

auto temperature_bias(Parameters& p) {
  const auto coefficient = p.per_axis("coefficient");
  const auto profile = warm_up(p);
  return TemperatureBias{coefficient, profile, p.number("reference_temperature", 25)};
}

auto temperature_scale(Parameters& p) {
  const auto coefficient = p.per_axis("coefficient");
  const auto profile = warm_up(p);
  return TemperatureScale{coefficient, profile, p.number("reference_temperature", 25)};
}

auto random_vibration(Parameters& p) {
  return RandomVibration{p.per_axis("standard_deviation"), p.per_axis("natural_frequency"),
                         p.per_axis("damping_ratio")};
}

StuckReadings<double> stuck_readings(Parameters& p) {
  const double probability = p.number("probability");
  return {probability, p.number("mean_length", 1)};
}

template <typename Model>
struct TermReader {
  std::string name, parameters;  // names in the file, and a text for --help-errors
  std::function<void(Parameters&, Model&)> add;
};

using SensorTermReader = TermReader<AnySensorModel>;

std::vector<SensorTermReader> bias_and_noise_terms() {
  using Model = AnySensorModel;
  return {{"constant_bias", "bias", [](auto& p, Model& m) { m.add(ConstantBias{p.per_axis("bias")}); }},
          {"turn_on_bias", "standard_deviation",
           [](auto& p, Model& m) { m.add(TurnOnBias{p.per_axis("standard_deviation")}); }},
          {"white_noise", "density", [](auto& p, Model& m) { m.add(WhiteNoise{p.per_axis("density")}); }},
          {"random_walk", "density", [](auto& p, Model& m) { m.add(RandomWalk{p.per_axis("density")}); }},
          {"gauss_markov", "standard_deviation, correlation_time, [initial_value]",
           [](auto& p, Model& m) { m.add(gauss_markov(p)); }},
          {"bias_instability",
           "coefficient (B) or floor (0.664 B, the in-run stability of data sheets), [shortest], [longest]",
           [](auto& p, Model& m) { m.add(bias_instability(p)); }},
          {"rate_ramp", "slope", [](auto& p, Model& m) { m.add(RateRamp{p.per_axis("slope")}); }},
          {"quantization_noise", "coefficient",
           [](auto& p, Model& m) { m.add(QuantizationNoise{p.per_axis("coefficient")}); }},
          {"correlated_noise", "density, correlation (matrix)",
           [](auto& p, Model& m) { m.add(CorrelatedNoise{p.per_axis("density"), p["correlation"].matrix()}); }},
          {"spikes", "probability, standard_deviation",
           [](auto& p, Model& m) { m.add(Spikes{p.per_axis("probability"), p.per_axis("standard_deviation")}); }}};
}

std::vector<SensorTermReader> scale_and_output_terms() {
  using Model = AnySensorModel;
  return {
      {"quantization", "least_significant_bit",
       [](auto& p, Model& m) { m.add(Quantization{p.per_axis("least_significant_bit")}); }},
      {"saturation", "limit", [](auto& p, Model& m) { m.add(Saturation{p.per_axis("limit")}); }},
      {"scale_factor", "error", [](auto& p, Model& m) { m.add(ScaleFactor{p.per_axis("error")}); }},
      {"misalignment", "matrix or percent", [](auto& p, Model& m) { m.add(misalignment(p)); }},
      {"g_sensitivity", "sensitivity", [](auto& p, Model& m) { m.add(GSensitivity{p["sensitivity"].matrix()}); }},
      {"temperature_bias",
       "coefficient, initial_temperature, [final_temperature], [time_constant], [reference_temperature]",
       [](auto& p, Model& m) { m.add(temperature_bias(p)); }},
      {"temperature_scale",
       "coefficient, initial_temperature, [final_temperature], [time_constant], [reference_temperature]",
       [](auto& p, Model& m) { m.add(temperature_scale(p)); }},
      {"sinusoidal_vibration", "amplitude, frequency, [phase]",
       [](auto& p, Model& m) {
         m.add(SinusoidalVibration{p.per_axis("amplitude"), p.per_axis("frequency"), p.per_axis("phase", 0)});
       }},
      {"random_vibration", "standard_deviation, natural_frequency, damping_ratio",
       [](auto& p, Model& m) { m.add(random_vibration(p)); }},
      {"first_order_bandwidth", "cutoff", [](auto& p, Model& m) { m.add(FirstOrderBandwidth{p.per_axis("cutoff")}); }},
      {"second_order_bandwidth", "natural_frequency, damping_ratio",
       [](auto& p, Model& m) {
         m.add(SecondOrderBandwidth{p.per_axis("natural_frequency"), p.per_axis("damping_ratio")});
       }},
      {"scale_factor_asymmetry", "asymmetry",
       [](auto& p, Model& m) { m.add(ScaleFactorAsymmetry{p.per_axis("asymmetry")}); }},
      {"vibration_rectification", "coefficient",
       [](auto& p, Model& m) { m.add(VibrationRectification{p.per_axis("coefficient")}); }},
      {"g_squared_sensitivity", "sensitivity",
       [](auto& p, Model& m) { m.add(GSquaredSensitivity{p.per_axis("sensitivity")}); }},
      {"size_effect", "positions (matrix; column i: position of accelerometer i)",
       [](auto& p, Model& m) { m.add(SizeEffect{p["positions"].matrix()}); }},
      {"stuck_readings", "probability, [mean_length]", [](auto& p, Model& m) { m.add(stuck_readings(p)); }}};
}

const std::vector<SensorTermReader>& sensor_terms() {
  static const std::vector<SensorTermReader> table = [] {
    std::vector<SensorTermReader> all = bias_and_noise_terms();
    const std::vector<SensorTermReader> more = scale_and_output_terms();
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return table;
}

const std::vector<TermReader<AnyStampModel>>& stamp_terms() {
  using Model = AnyStampModel;
  static const std::vector<TermReader<Model>> table{
      {"clock_offset", "offset", [](auto& p, Model& m) { m.add(ClockOffset{p.number("offset")}); }},
      {"clock_drift", "rate", [](auto& p, Model& m) { m.add(ClockDrift{p.number("rate")}); }},
      {"stamp_jitter", "standard_deviation",
       [](auto& p, Model& m) { m.add(StampJitter{p.number("standard_deviation")}); }},
      {"dropped_samples", "probability", [](auto& p, Model& m) { m.add(DroppedSamples{p.number("probability")}); }}};
  return table;
}

template <typename Model>
Model read_terms(const YamlReader& list, const std::vector<TermReader<Model>>& table) {
  Model model;
  for (const YamlReader& element : list.elements()) {
    const auto keys = element.keys();
    if (keys.size() != 1) element.fail(concat(keys.size(), " keys, expected a list of terms: `- white_noise: 0.01`"));
    const auto reader = std::find_if(table.begin(), table.end(), [&](const auto& r) { return r.name == keys[0]; });
    if (reader == table.end()) {
      std::string known;
      for (const auto& term : table) known += (known.empty() ? "" : ", ") + term.name;
      element.fail(concat("unknown term ", keys[0], ", expected ", known));
    }
    Parameters parameters(element[keys[0]]);
    try {
      reader->add(parameters, model);
    } catch (const std::invalid_argument& error) {
      element.fail(error.what());
    }
    parameters.expect_no_more();
  }
  return model;
}

}  // namespace

AnyImu read_error_yaml(const std::filesystem::path& path) {
  const YamlReader file = YamlReader::open(path);
  file.expect_only({"gyro", "accel", "stamps"});
  AnyImu imu;
  if (file.has("gyro")) imu.gyro = read_terms(file["gyro"], sensor_terms());
  if (file.has("accel")) imu.accel = read_terms(file["accel"], sensor_terms());
  if (file.has("stamps")) imu.stamps = read_terms(file["stamps"], stamp_terms());
  return imu;
}

std::string error_yaml_help() {
  std::string text = "terms of gyro and accel:\n";
  for (const auto& term : sensor_terms()) text += "  " + term.name + ": " + term.parameters + '\n';
  text += "terms of stamps:\n";
  for (const auto& term : stamp_terms()) text += "  " + term.name + ": " + term.parameters + '\n';
  return text;
}

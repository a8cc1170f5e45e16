// SPDX-License-Identifier: MIT
#include "allan/deviation.hpp"

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <splinertia/allan/curve.hpp>
#include <splinertia/io/number_text.hpp>
#include <splinertia/io/text_file.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "support/common_options.hpp"
#include "support/concat.hpp"
#include "support/imu_log.hpp"

using namespace splinertia;

namespace {

allan::AveragingFactors factors_of(const std::string& text) {
  if (text == "all") return allan::AveragingFactors::all();
  if (text == "octave") return allan::AveragingFactors::octave();
  if (text == "decade") return allan::AveragingFactors::decade();
  if (text == "log") return allan::AveragingFactors::logarithmic();
  std::vector<std::string_view> words;
  split_fields(text, words);
  if (words.empty()) words.push_back(text);
  std::vector<std::int64_t> factors;
  for (const std::string_view word : words) {
    const Parsed<std::int64_t> factor = parse_integer(word);
    if (factor.problem) {
      throw std::invalid_argument(
          concat("--factors: ", excerpt(word), ' ', factor.problem, ", expected all, octave, decade, log or 1,2,5"));
    }
    factors.push_back(factor.value);
  }
  return allan::AveragingFactors::given(std::move(factors));
}

using Curve = allan::DeviationCurve<double>;
using Signal = allan::IntegratedSignal<double>;
using Settings = allan::DeviationOptions<double>;
const std::map<std::string, Curve (*)(const Signal&, const Settings&)> deviations{
    {"adev", allan::curve<allan::AllanDeviation, double>},
    {"oadev", allan::curve<allan::OverlappingAllanDeviation, double>},
    {"mdev", allan::curve<allan::ModifiedAllanDeviation, double>},
    {"tdev", allan::curve<allan::TimeDeviation, double>},
    {"hdev", allan::curve<allan::HadamardDeviation, double>},
    {"ohdev", allan::curve<allan::OverlappingHadamardDeviation, double>},
    {"totdev", allan::curve<allan::TotalDeviation, double>}};

std::string text_of(double value) {
  std::array<char, number_text_size> text{};
  return {text.data(), real_to_chars(text.data(), value)};
}

}  // namespace

void print_deviation(const DeviationOptions& o) {
  Settings settings{.factors = factors_of(o.factors), .confidence = o.confidence, .alpha = o.alpha};
  if (o.intervals == "exact") settings.phase_model = allan::PhaseModel::sampled;
  const std::vector<double> numbers = read_numbers(o.file);
  const auto curve_of = [&] {
    try {
      const Signal signal = o.phase_data ? Signal::from_integral(numbers, o.rate) : Signal(numbers, o.rate);
      return deviations.at(o.type)(signal, settings);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(concat(o.file.string(), ": ", error.what()));
    }
  };
  const Curve curve = curve_of();
  std::puts("m,tau,n,deviation,lower,upper,alpha");
  for (const auto& point : curve.points) {
    std::printf("%s,%s,%s,%s,%s,%s,%d\n", std::to_string(point.factor).c_str(), text_of(point.tau).c_str(),
                std::to_string(point.terms).c_str(), text_of(point.deviation).c_str(),
                text_of(point.interval.lower).c_str(), text_of(point.interval.upper).c_str(), point.alpha);
  }
}

void add_deviation_options(CLI::App& app, DeviationOptions& o) {
  app.add_option("file", o.file, "file with one number per line and # comments; - is the standard input")->required();
  app.add_option("--type", o.type, "type of deviation")->check(CLI::IsMember(deviations))->capture_default_str();
  add_rate_option(app, o.rate);
  auto* phase = app.add_flag("--phase-data", o.phase_data, "the numbers are integrals (phase [s], angle)");
  app.add_flag("--rate-data", o.rate_data, "the numbers are rates (the default)")->excludes(phase);
  app.add_option("--factors", o.factors, "averaging factors [samples]: all, octave, decade, log, or numbers: 1,2,5")
      ->capture_default_str();
  app.add_option("--confidence", o.confidence, "confidence level of the intervals")->capture_default_str();
  app.add_option("--intervals", o.intervals,
                 "published: as in Greenhall and Riley 2003 and Stable32; exact: for numbers that are samples")
      ->check(CLI::IsMember({"published", "exact"}))
      ->capture_default_str();
  app.add_option("--alpha", o.alpha, "power law of the spectrum, for the intervals; default: identified at each factor")
      ->check(CLI::Range(-4, 2));
}

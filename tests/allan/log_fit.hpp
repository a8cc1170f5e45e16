// SPDX-License-Identifier: MIT
/// What a fit of a log needs, in one place: SpectralFit and the likelihood read the spectrum, which they do not own.
#pragma once

#include <splinertia/allan/detail/model/model_likelihood.hpp>
#include <splinertia/allan/detail/model/spectral_fit.hpp>
#include <splinertia/allan/detail/pooled_spectrum.hpp>
#include <splinertia/allan/difference_spectrum.hpp>
#include <splinertia/allan/integrated_signal.hpp>
#include <splinertia/allan/noise_terms.hpp>
#include <string>
#include <vector>

namespace splinertia::testing {

/// The spectrum of one log and a fit of all its bins.
struct LogFit {
  LogFit(const std::vector<double>& y, double rate)
      : spectra{allan::DifferenceSpectrum<double>(allan::IntegratedSignal<double>(y, rate))},
        pooled(spectra),
        fit(pooled, std::vector<bool>(pooled.bins().size(), true)),
        likelihood(fit) {}
  LogFit(const LogFit&) = delete;
  LogFit& operator=(const LogFit&) = delete;

  std::vector<allan::DifferenceSpectrum<double>> spectra;
  allan::detail::PooledSpectrum<double> pooled;
  allan::detail::SpectralFit<double> fit;
  allan::detail::ModelLikelihood<double> likelihood;
};

/// Such as "NKB".
[[nodiscard]] inline std::string symbols(allan::NoiseTerms terms) {
  std::string all;
  for (const allan::NoiseTerm term : allan::noise_terms) {
    if (terms.has(term)) all += allan::symbol(term);
  }
  return all;
}

}  // namespace splinertia::testing

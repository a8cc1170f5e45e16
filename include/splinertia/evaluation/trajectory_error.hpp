// SPDX-License-Identifier: MIT
/// Errors of an estimated trajectory against a reference, as Grupp's evo defines them (github.com/MichaelGrupp/evo,
/// 1.38):
///
///   auto pairs = aligned(associate(reference, estimate), Alignment::se3);
///   auto ate = error_statistics(absolute_errors(pairs), &PoseError<double>::translation);
///   auto rpe = error_statistics(relative_errors(pairs, index_pairs_by_frames(pairs.size(), 10)),
///                               &PoseError<double>::rotation);
///   ate.rmse;
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <ranges>
#include <splinertia/detail/finite.hpp>
#include <splinertia/detail/refuse.hpp>
#include <splinertia/evaluation/trajectory_alignment.hpp>
#include <splinertia/evaluation/trajectory_association.hpp>
#include <splinertia/evaluation/trajectory_pairs.hpp>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace splinertia {

template <typename Scalar>
struct PoseError {
  Scalar translation;  ///< m
  Scalar rotation;     ///< angle, rad, 0 to π
};

/// ATE (evo: APE, translation part and rotation angle) of each pair: |p_est − p_ref| and |log(R_refᵀ R_est)|. Sturm et
/// al., "A benchmark for the evaluation of RGB-D SLAM systems", IROS 2012, section VI.
template <Pose G, TimePoint Time>
[[nodiscard]] std::vector<PoseError<ScalarOf<G>>> absolute_errors(const std::vector<PosePair<G, Time>>& pairs) {
  std::vector<PoseError<ScalarOf<G>>> errors;
  errors.reserve(pairs.size());
  for (const auto& [time, reference, estimate] : pairs) {
    errors.push_back(
        {(position(estimate) - position(reference)).norm(), increment(rotation(reference), rotation(estimate)).norm()});
  }
  return errors;
}

/// RPE for each pair of indices i, j: translation part and rotation angle of E = (Q_i⁻¹ Q_j)⁻¹ (P_i⁻¹ P_j), with Q the
/// reference and P the estimate in SE(3). Sturm et al., (1). Requires that the indices are those of `pairs`.
template <Pose G, TimePoint Time>
[[nodiscard]] std::vector<PoseError<ScalarOf<G>>> relative_errors(const std::vector<PosePair<G, Time>>& pairs,
                                                                  const IndexPairs& indices) {
  using Scalar = ScalarOf<G>;
  using SO3 = GroupTraits<Sophus::SO3<Scalar>>;
  const auto displacement = [](const G& from, const G& to) {
    return detail::rotate_inverse<Scalar>(rotation(from).unit_quaternion(), position(to) - position(from));
  };
  const auto turned = [](const G& from, const G& to) {
    return SO3::compose(SO3::inverse(rotation(from)), rotation(to));
  };
  std::vector<PoseError<Scalar>> errors;
  errors.reserve(indices.size());
  for (const auto& [i, j] : indices) {
    const G &q0 = pairs[i].reference, &q1 = pairs[j].reference, &p0 = pairs[i].estimate, &p1 = pairs[j].estimate;
    errors.push_back(
        {(displacement(p0, p1) - displacement(q0, q1)).norm(), increment(turned(q0, q1), turned(p0, p1)).norm()});
  }
  return errors;
}

/// Statistics in the unit of the errors; sse in its square.
template <typename Scalar>
struct ErrorStatistics {
  std::size_t count;
  Scalar rmse;  ///< √(sse/count)
  Scalar mean;
  Scalar median;              ///< for an even count, the mean of the two in the middle
  Scalar standard_deviation;  ///< of the population: √(Σ (e − mean)²/count)
  Scalar min, max;
  Scalar sse;  ///< Σ e²
};

/// Statistics of the errors, or of a part of each: `error_statistics(errors, &PoseError<double>::rotation)`. Throws
/// std::invalid_argument if there are no errors and if one is not finite.
template <std::ranges::input_range Errors, typename Part = std::identity>
[[nodiscard]] auto error_statistics(const Errors& errors, Part part = {}) {
  using Scalar = std::remove_cvref_t<std::invoke_result_t<Part&, std::ranges::range_reference_t<const Errors>>>;
  using std::sqrt;
  std::vector<Scalar> values;
  for (const auto& error : errors) {
    values.push_back(std::invoke(part, error));
    if (!detail::is_finite(values.back())) {
      detail::refuse<std::invalid_argument>("error_statistics: error ", values.size() - 1, " is not finite");
    }
  }
  if (values.empty()) detail::refuse<std::invalid_argument>("error_statistics: no errors");
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  ErrorStatistics<Scalar> s{};
  s.count = values.size();
  s.min = values.front();
  s.max = values.back();
  s.median = values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / Scalar(2);
  for (const Scalar& e : values) {
    s.mean += e;
    s.sse += e * e;
  }
  const Scalar count = static_cast<Scalar>(values.size());
  s.mean /= count;
  s.rmse = sqrt(s.sse / count);
  Scalar squares(0);
  for (const Scalar& e : values) squares += (e - s.mean) * (e - s.mean);
  s.standard_deviation = sqrt(squares / count);
  return s;
}

}  // namespace splinertia

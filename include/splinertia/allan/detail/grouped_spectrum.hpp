// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <splinertia/allan/detail/pooled_spectrum.hpp>
#include <vector>

namespace splinertia::allan::detail {

/// The used bins of a spectrum in groups. Above the 64th bin, neighbours form groups as wide as a tenth of their
/// frequency, over which every noise term is nearly linear.
template <typename Scalar>
struct GroupedSpectrum {
  using Column = Eigen::Array<Scalar, Eigen::Dynamic, 1>;
  static constexpr int powers = PooledSpectrum<Scalar>::powers;

  struct Group {
    std::size_t begin, end;  ///< bins
  };
  std::vector<Group> groups;
  Column frequency;  ///< centre of a group, Hz
  Column count;      ///< number of b_k, weighted
  Column power;      ///< Σ b_k², weighted, in unit()²
  Column share;      ///< weight of each b_k: 1, or less to keep to most_count
  Eigen::Array<Scalar, Eigen::Dynamic, powers> basis;

  /// Each bin counts as at most `most_count` of b_k.
  GroupedSpectrum(const PooledSpectrum<Scalar>& spectrum, const std::vector<bool>& included, Scalar most_count) {
    const auto& bins = spectrum.bins();
    constexpr std::size_t alone = 64;
    Scalar first = 0;
    bool joins = false;
    for (std::size_t i = 0; i < bins.size(); joins = included[i], ++i) {
      if (!included[i]) continue;
      if (!joins || i <= alone || bins[i].frequency * 10 > first * 11) {
        groups.push_back({i, i});
        first = bins[i].frequency;
      }
      groups.back().end = i + 1;
    }
    const auto size = static_cast<Eigen::Index>(groups.size());
    for (Column* column : {&frequency, &count, &power, &share}) column->setZero(size);
    basis.setZero(size, powers);
    for (Eigen::Index g = 0; g < size; ++g) {
      const auto [begin, end] = group(g);
      Eigen::Matrix<Scalar, powers, 1> sum = Eigen::Matrix<Scalar, powers, 1>::Zero();
      for (std::size_t i = begin; i < end; ++i) {
        count[g] += bins[i].count;
        power[g] += bins[i].power;
        sum += bins[i].count * bins[i].basis;
      }
      basis.row(g) = sum / count[g];
      frequency[g] = (bins[begin].frequency + bins[end - 1].frequency) / 2;
      share[g] = (std::min)(Scalar(1), most_count * static_cast<Scalar>(end - begin) / count[g]);
    }
    count *= share;
    power *= share;
  }

  [[nodiscard]] const Group& group(Eigen::Index g) const { return groups[static_cast<std::size_t>(g)]; }
};

}  // namespace splinertia::allan::detail

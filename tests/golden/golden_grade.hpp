// SPDX-License-Identifier: MIT
/// How an error e = |got − gold| (largest component) is judged, and the report that is made of it (README.md, "How to
/// judge an error"):
///
///   grade A  e ≤ C eps (scale + |gold|)   scale: the natural magnitude, of the exact increments
///   grade B  e ≤ C eps (cond + |gold|)    cond: what a rounding of every input by eps changes
///
/// C is the figure that is reported, and must not exceed 4 (20 for Jacobians with respect to control points). double
/// and long double are held to grade A, each with its own eps; float to grade A where all inputs are floats (f32 = 1),
/// else, the inputs being rounded, to grade B.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iosfwd>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "golden_table.hpp"

namespace golden {

enum class Grade { A, B };

inline constexpr double value_limit = 4;
inline constexpr double jacobian_limit = 20;

/// A number that is compared: natural magnitude, condition, and the largest C that passes. A condition of NaN (an
/// increment of exactly π) leaves grade A as the only grade.
struct Measure {
  long double scale = 0;
  long double cond = 0;
  double limit = value_limit;
};

/// One line of the report: the rows of one class of one file, in one scalar type.
struct Line {
  std::string file, label, scalar;
  int rows = 0, skipped = 0;
  double worst[2] = {-1, -1};  // C of grades A and B, negative when none was measured
  double worst_share = -1;     // of its limit
  std::string worst_row, worst_quantity;
};

class Report {
 public:
  [[nodiscard]] Line& line(const Row& row, std::string_view scalar);
  /// A remark on a file: columns that are not checked, a file that is not known.
  void note(std::string_view file, std::string text);
  [[nodiscard]] bool passed() const;
  [[nodiscard]] const std::vector<Line>& lines() const { return lines_; }
  void print(std::ostream& out) const;
  /// The lines that passed a limit.
  void print_failures(std::ostream& out) const;

 private:
  std::vector<Line> lines_;
  std::vector<std::pair<std::string, std::string>> notes_;
};

template <typename Scalar>
inline constexpr std::string_view scalar_name = std::is_same_v<Scalar, float>    ? "float"
                                                : std::is_same_v<Scalar, double> ? "double"
                                                                                 : "long double";

/// The components of a vector or matrix, row by row.
template <typename Derived>
[[nodiscard]] std::vector<long double> flat(const Eigen::MatrixBase<Derived>& m) {
  std::vector<long double> values;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j < m.cols(); ++j) values.push_back(static_cast<long double>(m(i, j)));
  }
  return values;
}

using Numbers = std::vector<long double>;

[[nodiscard]] inline Numbers part(const Numbers& values, std::size_t begin, std::size_t size) {
  if (begin + size > values.size()) throw std::runtime_error("a cell has fewer numbers than its column promises");
  const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
  return {first, first + static_cast<std::ptrdiff_t>(size)};
}

/// A quaternion with the sign of gold's: q and −q are the same rotation.
[[nodiscard]] inline Numbers signed_like(const Numbers& gold, Numbers q) {
  long double dot = 0;
  for (std::size_t i = 0; i < q.size(); ++i) dot += q[i] * gold.at(i);
  if (dot < 0) {
    for (long double& x : q) x = -x;
  }
  return q;
}

/// The largest component.
[[nodiscard]] inline long double magnitude(const Numbers& values) {
  long double largest = 0;
  for (const long double x : values) largest = std::max(largest, std::abs(x));
  return largest;
}

/// Σ_c |τ_c ∂M/∂τ_c|, the largest entry, of a 3×3 matrix M(τ). A table's derivative has M's 9 entries for each component
/// of τ.
template <typename Derived>
[[nodiscard]] long double entry_condition(const Eigen::MatrixBase<Derived>& tau, const Numbers& derivative) {
  long double largest = 0;
  for (std::size_t entry = 0; entry < 9; ++entry) {
    long double sum = 0;
    for (Eigen::Index c = 0; c < tau.size(); ++c) {
      sum += std::abs(static_cast<long double>(tau[c]) * derivative.at(9 * static_cast<std::size_t>(c) + entry));
    }
    largest = std::max(largest, sum);
  }
  return largest;
}

/// Errors below this are underflow: intermediate products have left the range of the type (double: README.md).
template <typename Scalar>
inline constexpr long double underflow_floor =
    std::is_same_v<Scalar, float> ? 1e-31L : 1e-290L;  // numeric_limits<float>::min() / epsilon()

/// Compares what was computed for one row, in one scalar type.
template <typename Scalar>
class Grader {
 public:
  Grader(Report& report, const Row& row)
      : line_(report.line(row, scalar_name<Scalar>)),
        id_(row.text("id")),
        grade_(std::is_same_v<Scalar, float> && !row.flag("f32") ? Grade::B : Grade::A) {
    ++line_.rows;
  }

  [[nodiscard]] Grade grade() const { return grade_; }
  void skip() { ++line_.skipped; }
  /// A row that could not be computed at all.
  void fail(std::string_view reason) { note_worst(std::numeric_limits<double>::infinity(), reason); }

  void check(std::string_view quantity, const Numbers& got, const Numbers& gold, const Measure& measure = {}) {
    if (got.size() != gold.size()) {
      throw std::runtime_error(line_.file + ", row " + id_ + ", " + std::string(quantity) + ": " +
                               std::to_string(gold.size()) + " numbers where " + std::to_string(got.size()) +
                               " were expected");
    }
    long double error = 0;
    for (std::size_t i = 0; i < got.size(); ++i) {
      const long double e = std::abs(got[i] - gold[i]);
      if (!(e <= error)) error = e;  // keeps a NaN
      if (std::isnan(error)) break;
    }
    const Grade judged = std::isnan(measure.cond) ? Grade::A : grade_;
    const double c[2] = {units(error, measure.scale + magnitude(gold)), units(error, measure.cond + magnitude(gold))};
    line_.worst[0] = std::max(line_.worst[0], grade_ == Grade::A || judged == Grade::A ? c[0] : -1);
    line_.worst[1] = std::max(line_.worst[1], std::isnan(measure.cond) ? -1 : c[1]);
    note_worst(c[judged == Grade::A ? 0 : 1] / measure.limit, quantity);
  }

 private:
  void note_worst(double share, std::string_view quantity) {
    if (share > line_.worst_share) {
      line_.worst_share = share;
      line_.worst_row = id_;
      line_.worst_quantity = quantity;
    }
  }

  /// C: the error in units of eps times the size.
  [[nodiscard]] static double units(long double error, long double size) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (std::isnan(error)) return infinity;
    if (error <= underflow_floor<Scalar>) return 0;
    if (size == 0) return infinity;
    return static_cast<double>((error - underflow_floor<Scalar>) /
                               (static_cast<long double>(std::numeric_limits<Scalar>::epsilon()) * size));
  }

  Line& line_;
  std::string id_;
  Grade grade_;
};

/// Runs check<Scalar>(row, report) over all rows, for the three built-in types.
template <typename Check>
void for_all_scalars(const Table& table, const Check& check) {
  for (std::size_t i = 0; i < table.size(); ++i) check.template operator()<float>(table[i]);
  for (std::size_t i = 0; i < table.size(); ++i) check.template operator()<double>(table[i]);
  for (std::size_t i = 0; i < table.size(); ++i) check.template operator()<long double>(table[i]);
}

template <typename Scalar, int N>
[[nodiscard]] Eigen::Matrix<Scalar, N, 1> input_vector(const Row& row, std::string_view column, std::size_t begin = 0) {
  const auto values = row.inputs<Scalar>(column);
  Eigen::Matrix<Scalar, N, 1> v;
  for (int i = 0; i < N; ++i) v[i] = values.at(begin + static_cast<std::size_t>(i));
  return v;
}

}  // namespace golden

// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <iterator>
#include <splinertia/detail/simd_pack.hpp>
#include <utility>

namespace splinertia::detail {

/// Samples of `Rows` numbers each, stored as `Rows` contiguous rows: number by number, not sample by sample. SIMD code
/// writes this order; plots, filters and Allan analysis read it. Behind each row there is room for one SIMD pack
/// (SimdPack), so that whole packs can be written up to the end.
///
/// Capacity: the number of samples if the memory is part of the object; with Eigen::Dynamic, resize() sets the number.
template <typename Scalar, int Rows, int Capacity = Eigen::Dynamic>
class SampleRows {
 public:
  /// Makes room for `size` samples. The previous contents are lost. Allocates only if the size changes.
  void resize(std::size_t size)
    requires(Capacity == Eigen::Dynamic)
  {
    numbers_.resize(Rows, columns(static_cast<Eigen::Index>(size)));
    size_ = size;
  }

  [[nodiscard]] std::size_t size() const { return size_; }

  /// Writes to the rows. A loop with a copy of its own can keep it in registers.
  class Writer {
   public:
    explicit Writer(SampleRows& rows) : data_(rows.numbers_.data()), stride_(rows.numbers_.cols()) {}

    /// Writes v[0] … v[Count − 1] to the rows from Row on, for sample i. If they are SIMD packs (SimdPack), for the
    /// samples from i on.
    template <int Row, int Count>
    void write(std::size_t i, const auto& v) const {
      static_assert(Row + Count <= Rows);
      // Unrolled, so that v need not be in memory.
      [&]<int... K>(std::integer_sequence<int, K...>) {
        (put(data_ + (Row + K) * stride_ + i, v[static_cast<std::size_t>(K)]), ...);
      }(std::make_integer_sequence<int, Count>{});
    }

   private:
    static void put(Scalar* to, const Scalar& x) { *to = x; }
    template <int N, int Bytes>
    static void put(Scalar* to, const SimdPack<Scalar, N, Bytes>& x) {
      x.store(to);
    }
    Scalar* data_;
    std::ptrdiff_t stride_;
  };

  /// Rows r … r + Count − 1, a matrix of Count × size(): a view of the rows, or a copy if the object is a temporary.
  template <int Count>
  [[nodiscard]] auto rows(int r) const& {
    return numbers_.template middleRows<Count>(r).leftCols(static_cast<Eigen::Index>(size_));
  }
  template <int Count>
  [[nodiscard]] Eigen::Matrix<Scalar, Count, Eigen::Dynamic, Eigen::RowMajor> rows(int r) && {
    return rows<Count>(r);
  }

  /// Rows r … r + Count − 1 of sample i.
  template <int Count>
  [[nodiscard]] Eigen::Matrix<Scalar, Count, 1> column(int r, std::size_t i) const {
    Eigen::Matrix<Scalar, Count, 1> v;
    for (int k = 0; k < Count; ++k) v[k] = numbers_(r + k, static_cast<Eigen::Index>(i));
    return v;
  }

 private:
  // Whole SIMD packs plus three. One is for the lanes behind the last sample; the others make the length of a row
  // differ from a power of two, so that not all rows lie in the same set of the cache.
  [[nodiscard]] static constexpr Eigen::Index columns(Eigen::Index size) {
    constexpr Eigen::Index lanes = NativeSimdPack<Scalar>::size;
    return (size / lanes + 3) * lanes;
  }
  static constexpr int fixed_columns =
      Capacity == Eigen::Dynamic ? Eigen::Dynamic : static_cast<int>(columns(Capacity));
  Eigen::Matrix<Scalar, Rows, fixed_columns, Eigen::RowMajor> numbers_;
  std::size_t size_ = Capacity == Eigen::Dynamic ? 0 : static_cast<std::size_t>(Capacity);
};

/// Iterates over samples[0], samples[1], … of any container that makes its samples on access.
template <typename Samples>
class SampleIterator {
 public:
  using value_type = decltype(std::declval<const Samples&>()[std::size_t{}]);
  using difference_type = std::ptrdiff_t;
  using iterator_concept = std::forward_iterator_tag;

  SampleIterator() = default;
  SampleIterator(const Samples& samples, std::size_t index) : samples_(&samples), index_(index) {}
  [[nodiscard]] value_type operator*() const { return (*samples_)[index_]; }
  SampleIterator& operator++() {
    ++index_;
    return *this;
  }
  SampleIterator operator++(int) {
    SampleIterator before = *this;
    ++*this;
    return before;
  }
  [[nodiscard]] bool operator==(const SampleIterator&) const = default;

 private:
  const Samples* samples_ = nullptr;
  std::size_t index_ = 0;
};

}  // namespace splinertia::detail

// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <splinertia/detail/inline.hpp>
#include <utility>

namespace splinertia::detail {

/// In place of the number of a reading: there are no more.
inline constexpr std::size_t no_reading = static_cast<std::size_t>(-1);

/// Iterates over the readings of a simulated run, each of which is made when it is reached: an input iterator for range
/// loops, ranges and the constructors of containers. A Run has
///   Reading      the type of its readings
///   next(i)      makes the first reading from number i on that is not dropped, and returns its number, or no_reading
///   reading()    the one made last
/// A default-constructed iterator is the end.
template <typename Run>
class RunIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = typename Run::Reading;
  using difference_type = std::ptrdiff_t;
  using pointer = const value_type*;
  using reference = const value_type&;

  RunIterator() = default;
  /// The first reading of a run, which is constructed from `run`.
  template <typename... Arguments>
  SPLINERTIA_ALWAYS_INLINE explicit RunIterator(std::in_place_t, const Arguments&... run)
      : run_(std::in_place, run...), index_(run_->next(0)) {}

  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE reference operator*() const { return run_->reading(); }
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE pointer operator->() const { return std::addressof(run_->reading()); }
  SPLINERTIA_ALWAYS_INLINE RunIterator& operator++() {
    index_ = run_->next(index_ + 1);
    return *this;
  }
  /// Returns the reading before, not a second iterator.
  auto operator++(int) {
    struct Before {
      value_type reading;
      [[nodiscard]] const value_type& operator*() const { return reading; }
    };
    Before before{**this};
    ++*this;
    return before;
  }
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE bool operator==(const RunIterator& other) const {
    return index_ == other.index_;
  }

 private:
  std::optional<Run> run_;
  std::size_t index_ = no_reading;
};

}  // namespace splinertia::detail

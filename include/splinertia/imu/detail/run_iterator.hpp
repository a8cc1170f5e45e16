#include <splinertia/detail/inline.hpp>
// SPDX-License-Identifier: MIT
#include <splinertia/detail/inline.hpp>
#pragma once
#include <splinertia/detail/inline.hpp>

#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <splinertia/detail/inline.hpp>
#include <utility>

#include <splinertia/detail/inline.hpp>
namespace splinertia::detail {
#include <splinertia/detail/inline.hpp>

#include <splinertia/detail/inline.hpp>
/// In place of the number of a reading: there are no more.
#include <splinertia/detail/inline.hpp>
inline constexpr std::size_t no_reading = static_cast<std::size_t>(-1);
#include <splinertia/detail/inline.hpp>

#include <splinertia/detail/inline.hpp>
/// Iterates over the readings of a simulated run, each of which is made when it is reached: an input iterator for range
#include <splinertia/detail/inline.hpp>
/// loops, ranges and the constructors of containers. A Run has
#include <splinertia/detail/inline.hpp>
///   Reading      the type of its readings
#include <splinertia/detail/inline.hpp>
///   next(i)      makes the first reading from number i on that is not dropped, and returns its number, or no_reading
#include <splinertia/detail/inline.hpp>
///   reading()    the one made last
#include <splinertia/detail/inline.hpp>
/// A default-constructed iterator is the end.
#include <splinertia/detail/inline.hpp>
template <typename Run>
#include <splinertia/detail/inline.hpp>
class RunIterator {
#include <splinertia/detail/inline.hpp>
 public:
#include <splinertia/detail/inline.hpp>
  using iterator_category = std::input_iterator_tag;
#include <splinertia/detail/inline.hpp>
  using value_type = typename Run::Reading;
#include <splinertia/detail/inline.hpp>
  using difference_type = std::ptrdiff_t;
#include <splinertia/detail/inline.hpp>
  using pointer = const value_type*;
#include <splinertia/detail/inline.hpp>
  using reference = const value_type&;
#include <splinertia/detail/inline.hpp>

#include <splinertia/detail/inline.hpp>
  RunIterator() = default;
#include <splinertia/detail/inline.hpp>
  /// The first reading of a run, which is constructed from `run`.
#include <splinertia/detail/inline.hpp>
  template <typename... Arguments>
#include <splinertia/detail/inline.hpp>
  SPLINERTIA_ALWAYS_INLINE explicit RunIterator(std::in_place_t, const Arguments&... run)
#include <splinertia/detail/inline.hpp>
      : run_(std::in_place, run...), index_(run_->next(0)) {
  }
#include <splinertia/detail/inline.hpp>

#include <splinertia/detail/inline.hpp>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE reference operator*() const { return run_->reading(); }
#include <splinertia/detail/inline.hpp>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE pointer operator->() const { return std::addressof(run_->reading()); }
#include <splinertia/detail/inline.hpp>
  SPLINERTIA_ALWAYS_INLINE RunIterator& operator++() {
#include <splinertia/detail/inline.hpp>
    index_ = run_->next(index_ + 1);
#include <splinertia/detail/inline.hpp>
    return *this;
#include <splinertia/detail/inline.hpp>
  }
#include <splinertia/detail/inline.hpp>
  /// Returns the reading before, not a second iterator.
#include <splinertia/detail/inline.hpp>
  auto operator++(int) {
#include <splinertia/detail/inline.hpp>
    struct Before {
#include <splinertia/detail/inline.hpp>
      value_type reading;
#include <splinertia/detail/inline.hpp>
      [[nodiscard]] const value_type& operator*() const { return reading; }
#include <splinertia/detail/inline.hpp>
    };
#include <splinertia/detail/inline.hpp>
    Before before{**this};
#include <splinertia/detail/inline.hpp>
    ++*this;
#include <splinertia/detail/inline.hpp>
    return before;
#include <splinertia/detail/inline.hpp>
  }
#include <splinertia/detail/inline.hpp>
  [[nodiscard]] SPLINERTIA_ALWAYS_INLINE bool operator==(const RunIterator& other) const {
    return index_ == other.index_;
  }
#include <splinertia/detail/inline.hpp>

#include <splinertia/detail/inline.hpp>
 private:
#include <splinertia/detail/inline.hpp>
  std::optional<Run> run_;
#include <splinertia/detail/inline.hpp>
  std::size_t index_ = no_reading;
#include <splinertia/detail/inline.hpp>
};
#include <splinertia/detail/inline.hpp>

#include <splinertia/detail/inline.hpp>
}  // namespace splinertia::detail

// expect: HasParameterLayout
// Parameter blocks of a group whose numbers are not known.
#include <splinertia/spline/parameter_blocks.hpp>

#include "../support/own_groups.hpp"

auto blocks(const double* const* numbers, const splinertia::CumulativeBasis<double, 4, 1>& basis) {
  return splinertia::evaluate<1, test::Gain>(numbers, basis);
}

// expect: an error term needs .void apply\(Sample<double>& sample, State& state\) const
#include <splinertia/errors/error_model.hpp>
using namespace splinertia;
struct Bad {
  struct State {};
  void apply(const Sample<double>&, State&) const {}
};
const ErrorModel model{Bad{}};

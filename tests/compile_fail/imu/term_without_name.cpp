// expect: an error term needs a State: .*static constexpr std::string_view name
#include <splinertia/errors/error_model.hpp>
using namespace splinertia;
struct Bad {
  template <typename Normals>
  using State = Normals;
  void apply(SensorSample<double>& sample, auto& normals) const { sample.value += normals.template draw<double>(); }
};
const ErrorModel model{Bad{}};

// expect: the State of an error term needs a constructor
#include <splinertia/errors/error_model.hpp>
using namespace splinertia;
struct Bad {
  static constexpr std::string_view name = "bad";
  template <typename Normals>
  struct State {
    Normals normals;
    int count;
  };
  void apply(SensorSample<double>& sample, auto& state) const { sample.value += state.normals.template draw<double>(); }
};
const ErrorModel model{Bad{}};

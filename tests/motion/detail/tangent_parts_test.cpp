// SPDX-License-Identifier: MIT
#include <splinertia/group/sophus.hpp>
#include <splinertia/motion/detail/tangent_parts.hpp>

#include "support/catch.hpp"

using namespace splinertia;

TEMPLATE_TEST_CASE("The parts of a tangent vector turn and move the pose", "", SO3xR3<double>, Sophus::SE3d) {
  using G = TestType;
  const Tangent<G> tau = (Tangent<G>() << 0.1, -0.2, 0.3, 0.4, -0.5, 0.6).finished();
  // exp of a part alone only turns, or only moves.
  for (int first : {0, 3}) {
    Tangent<G> only = Tangent<G>::Zero();
    only.template segment<3>(first) = tau.template segment<3>(first);
    const G x = GroupTraits<G>::exp(only);
    CHECK((rotation(x).log() - detail::rotational_part<G>(only)).norm() < 1e-15);
    CHECK((position(x) - detail::translational_part<G>(only)).norm() < 1e-15);
  }
  CHECK(detail::rotational_part<G>(tau) != detail::translational_part<G>(tau));
}

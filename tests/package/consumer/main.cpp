// SPDX-License-Identifier: MIT
#include <iostream>
#include <splinertia/splinertia.hpp>

int main() {
  using Pose = splinertia::SO3xR3<double>;
  const Pose pose = splinertia::GroupTraits<Pose>::identity();
  const auto tangent = splinertia::GroupTraits<Pose>::log(pose);
  std::cout << "splinertia works: log(identity) = " << tangent.transpose() << "\n";
}

// SPDX-License-Identifier: MIT
// Instructions of a sample of an IMU along curves: `study_instructions --csv --instructions`, for benchmarks/study.py.
#include "kernels.hpp"

int main(int argc, char** argv) {
  std::vector<benchmark::Kernel> kernels;
  study::add_orders<splinertia::SO3xR3<float>>(kernels, "SO3xR3_float");
  study::add_orders<splinertia::SO3xR3<double>>(kernels, "SO3xR3_double");
  study::add_orders<Sophus::SE3f>(kernels, "SE3_float");
  study::add_orders<Sophus::SE3d>(kernels, "SE3_double");
  return benchmark::run(argc, argv, "A sample of an IMU along splines; a call is a sample.", kernels);
}

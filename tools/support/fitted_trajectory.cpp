// SPDX-License-Identifier: MIT
#include "support/fitted_trajectory.hpp"

#include <stdexcept>
#include <utility>

#include "support/concat.hpp"
#include "support/formatted.hpp"
#include "support/progress.hpp"

using namespace splinertia;
using std::chrono::nanoseconds;

// Defined in fit/fit_on_curve.hpp and compiled in the other files there.
template <Pose G, int Order>
FittedTrajectory fit_on_curve(const FitInput& input, const FitChoices& choices, const FitImu* imu);

std::vector<nanoseconds> FittedTrajectory::breaks() const {
  std::vector<nanoseconds> result{curve.start()};
  if (interval) {
    while (result.back() < curve.end()) result.push_back(result.back() + *interval);
  } else {
    for (const nanoseconds knot : knots) {
      if (knot > result.back() && knot <= curve.end()) result.push_back(knot);
    }
  }
  return result;
}

FitInput read_fit_input(const TrajectoryInput& input) {
  const Stage stage("reading");
  TrajectoryFile file = read_trajectory_input(input);
  std::string notes = note_lines(input, file);
  return {input.file, std::move(file.poses), std::move(notes)};
}

FittedTrajectory fit_trajectory(const FitInput& input, const FitChoices& choices, const FitImu* imu) {
  if (input.poses.size() < 2) {
    throw std::runtime_error(
        concat(input.file.string(), ": ", input.poses.empty() ? "no poses" : "1 pose", ", expected at least 2"));
  }
  const auto with_group = [&]<typename G>() {
    switch (choices.order) {
      case 3:
        return fit_on_curve<G, 3>(input, choices, imu);
      case 4:
        return fit_on_curve<G, 4>(input, choices, imu);
      case 5:
        return fit_on_curve<G, 5>(input, choices, imu);
      default:
        return fit_on_curve<G, 6>(input, choices, imu);
    }
  };
  return choices.group == "split" ? with_group.operator()<SO3xR3<double>>() : with_group.operator()<Sophus::SE3d>();
}

std::string not_converged(const FittedTrajectory& fitted, const FitChoices& choices) {
  if (!fitted.converged) {
    return fitted.iterations >= choices.most_iterations
               ? formatted("the fit has not converged: %d linear systems were not enough (--most-iterations)",
                           fitted.iterations)
               : formatted("the fit has not converged: after %d linear systems no step lowered the cost any more",
                           fitted.iterations);
  }
  if (fitted.imu && !fitted.imu->calibrated.converged) return "the calibration of the IMU has not converged";
  return "";
}

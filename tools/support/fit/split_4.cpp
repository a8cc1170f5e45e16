// SPDX-License-Identifier: MIT
#include "support/fit/fit_on_curve.hpp"

template FittedTrajectory fit_on_curve<splinertia::SO3xR3<double>, 4>(const FitInput&, const FitChoices&,
                                                                      const FitImu*);

// SPDX-License-Identifier: MIT
#include "fit_on_group.hpp"

template FittedTrajectory fit_trajectory<SO3xR3<double>>(const Poses&, const std::vector<EurocImu>&, const Options&);

// SPDX-License-Identifier: MIT
#include "fit_on_group.hpp"

template FittedTrajectory fit_trajectory<Sophus::SE3d>(const Poses&, const std::vector<EurocImu>&, const Options&);

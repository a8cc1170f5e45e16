// SPDX-License-Identifier: MIT
#include "subjects.hpp"

namespace study {

template std::vector<Subject> subjects<3>(const Poses&, double, std::span<const Truth>);

}  // namespace study

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/falcon/kinematics.hpp"
#include "device/omni/geometry.hpp"

#include <array>

namespace hapnet::device {

/// The arms whose geometry this software knows, for parse_limits().
inline constexpr std::array known_mechanisms{omni::mechanism, falcon::mechanism};

} // namespace hapnet::device

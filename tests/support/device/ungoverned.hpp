// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/governed_force.hpp"

namespace hapnet::device {

/// The only way around the governor, for tests of the code behind it.
struct UngovernedForTests {
    [[nodiscard]] static GovernedForce force(const base::Force& force)
    {
        return GovernedForce{force};
    }
};

[[nodiscard]] inline GovernedForce ungoverned(const base::Force& force)
{
    return UngovernedForTests::force(force);
}

} // namespace hapnet::device

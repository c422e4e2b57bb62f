// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/space.hpp"

namespace hapnet::device {

/// A force that may reach a hand. It is zero, with the motors off, unless a Governor made it. So no
/// force reaches a motor without passing a Governor.
class GovernedForce {
public:
    constexpr GovernedForce() = default;

    /// Returns the force in newtons, in the device's own frame; zero when the motors are off.
    [[nodiscard]] constexpr const base::Force& force() const { return force_; }
    /// True if the motors are to have power.
    [[nodiscard]] constexpr bool motors_on() const { return motors_on_; }

private:
    friend class Governor;
    friend struct UngovernedForTests;

    explicit constexpr GovernedForce(const base::Force& force) : force_{force}, motors_on_{true} {}

    base::Force force_;
    bool motors_on_ = false;
};

} // namespace hapnet::device

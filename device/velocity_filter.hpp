// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <optional>

namespace hapnet::device {

/// Computes a velocity from positions in encoder counts: their differences through a first-order
/// low-pass.
class VelocityFilter {
public:
    explicit VelocityFilter(double cutoff_hertz) : cutoff_hertz_{cutoff_hertz} {}

    /// Returns the velocity. `now` never runs backwards. The first position gives zero.
    [[nodiscard]] base::Velocity at(base::Position position, base::TimePoint now);

private:
    struct Last {
        base::TimePoint time;
        base::Position position;
    };

    double cutoff_hertz_;
    std::optional<Last> last_;
    glm::dvec3 velocity_{0.0};
    base::Duration elapsed_{}; // time step for which keeps_ and gain_per_s_ were computed
    double keeps_ = 0.0;
    double gain_per_s_ = 0.0;
};

} // namespace hapnet::device

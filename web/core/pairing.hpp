// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <cstddef>
#include <deque>
#include <glm/vec3.hpp>
#include <optional>

namespace hapnet::web {

/// Position and velocity of a body at a time; m and m/s.
struct Sample {
    base::TimePoint at;
    glm::dvec3 position{0.0};
    glm::dvec3 velocity{0.0};
};

/// The way of a body in the last two seconds. Between two samples it is the cubic that has their
/// positions and velocities (Hermite's): its error is h^4/384 times the fourth derivative, 1 nm for
/// the motion of task P1 at 60 samples a second; where the body is stopped by a blow, |dv| h / 8.
class Track {
public:
    static constexpr base::Duration kept{std::chrono::seconds{2}};
    static constexpr std::size_t samples_max = 512;
    /// Across a longer gap nothing is known.
    static constexpr base::Duration gap_max{std::chrono::milliseconds{300}};

    /// Adds a sample. A sample that is not later than the last one empties the track first.
    void add(const Sample& sample);
    void clear() { samples_.clear(); }

    [[nodiscard]] std::optional<base::TimePoint> newest() const;
    /// The place at a time; nullopt: the track does not reach there, or has a gap.
    [[nodiscard]] std::optional<glm::dvec3> at(base::TimePoint time) const;

private:
    std::deque<Sample> samples_; // ascending in time
};

/// The positions of two bodies at one time.
struct Apart {
    base::TimePoint at; // time on the clock of the first body's peer
    glm::dvec3 a{0.0};
    glm::dvec3 b{0.0};

    [[nodiscard]] double along_x_m() const;
    [[nodiscard]] double distance_m() const;
};

/// Returns both positions at the latest time that both tracks have. `ahead`: the clock of b minus
/// the clock of a.
[[nodiscard]] std::optional<Apart> apart(const Track& a, const Track& b, base::Duration ahead);

} // namespace hapnet::web

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

/// The path of a body in the last two seconds. Between two samples it is the cubic that has their
/// positions and velocities (Hermite's). Its error is h^4/384 times the fourth derivative: 1 nm for
/// the motion of task P1 at 60 samples a second. Where an impact stops the body it is |dv| h / 8.
class Track {
public:
    static constexpr base::Duration kept{std::chrono::seconds{2}};
    static constexpr std::size_t samples_max = 512;
    /// The longest gap that is interpolated. The place within a longer one is unknown.
    static constexpr base::Duration gap_max{std::chrono::milliseconds{300}};

    /// Adds a sample. A sample at the time of the last one is ignored. An earlier one empties the
    /// track first.
    void add(const Sample& sample);
    void clear() { samples_.clear(); }

    [[nodiscard]] std::optional<base::TimePoint> newest() const;
    /// Returns the place at a time; nullopt: the track does not reach there, or has a gap.
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

/// Returns both positions at the latest time that both tracks cover. `ahead` is the clock of b
/// minus the clock of a.
[[nodiscard]] std::optional<Apart> apart(const Track& a, const Track& b, base::Duration ahead);

} // namespace hapnet::web

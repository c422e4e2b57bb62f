// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/space.hpp"
#include "proto/wire/message.hpp"

#include <cstdint>

namespace hapnet::peer {

/// Running sums of the effects that this peer's hand has caused on a body since the session began.
/// Messages contain the sums themselves, so that lost messages lose no effect.
class EffectSums {
public:
    void add(base::Displacement moved) { displacement_ += moved; }
    void add(base::Impulse given) { impulse_ += given; }
    /// Adds a rotation by |turned| radians about the axis of `turned`.
    void add_rotation(const glm::dvec3& turned) { rotation_ += turned; }
    /// Adds an angular impulse about the body's centre, in N m s.
    void add_angular(const glm::dvec3& given) { angular_impulse_ += given; }

    /// Returns the displacement in micrometres, as messages contain it.
    [[nodiscard]] wire::Sums displacement_um() const { return millionths(displacement_.value); }
    /// Returns the impulse in micronewton seconds.
    [[nodiscard]] wire::Sums impulse_uns() const { return millionths(impulse_.value); }
    /// Returns the rotation in microradians.
    [[nodiscard]] wire::Sums rotation_urad() const { return millionths(rotation_); }
    /// Returns the angular impulse in millionths of N m s.
    [[nodiscard]] wire::Sums angular_impulse_unms() const { return millionths(angular_impulse_); }

private:
    [[nodiscard]] static wire::Sums millionths(const glm::dvec3& v)
    {
        // The rounding is written out, because the library function is not inlined and this runs
        // six times a tick.
        const auto rounded = [](double x) {
            return static_cast<std::uint32_t>(
                static_cast<std::int64_t>(x < 0.0 ? x - 0.5 : x + 0.5));
        };
        return {rounded(v.x * 1e6), rounded(v.y * 1e6), rounded(v.z * 1e6)};
    }

    base::Displacement displacement_;
    base::Impulse impulse_;
    glm::dvec3 rotation_{0.0};        // rad
    glm::dvec3 angular_impulse_{0.0}; // N m s
};

} // namespace hapnet::peer

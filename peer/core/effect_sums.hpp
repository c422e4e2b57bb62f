// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/space.hpp"

#include <array>
#include <cstdint>

namespace hapnet::peer {

/// Running sums of the effects that this peer's hand has caused since the session began. Messages
/// carry the sums themselves, so that a receiver that missed messages has missed no effect.
class EffectSums {
public:
    void add(base::Displacement moved) { displacement_ += moved; }
    void add(base::Impulse given) { impulse_ += given; }

    /// In nanometres.
    [[nodiscard]] std::array<std::int64_t, 3> displacement_nm() const
    {
        return billionths(displacement_.value);
    }
    /// In nanonewton seconds.
    [[nodiscard]] std::array<std::int64_t, 3> impulse_nns() const
    {
        return billionths(impulse_.value);
    }

private:
    [[nodiscard]] static std::array<std::int64_t, 3> billionths(const glm::dvec3& v)
    {
        // Written out: the library's rounding function is not inlined, and this runs six times a
        // tick.
        const auto rounded = [](double x) {
            return static_cast<std::int64_t>(x < 0.0 ? x - 0.5 : x + 0.5);
        };
        return {rounded(v.x * 1e9), rounded(v.y * 1e9), rounded(v.z * 1e9)};
    }

    base::Displacement displacement_;
    base::Impulse impulse_;
};

} // namespace hapnet::peer

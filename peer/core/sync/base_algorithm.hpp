// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/remote.hpp"
#include "peer/core/scene/world.hpp"

#include <optional>

namespace hapnet::peer {

/// This peer's hand among those of its copy of the scene. The other side's is none of them: it is
/// there by its force.
inline constexpr std::uint32_t own_hand = 0;

/// What one tick of an algorithm decides from, besides this peer's hand, which the world knows.
struct Situation {
    base::TimePoint now;
    scene::BodyId body = 0; // the shared one
    const Remote& remote;   // the other side as last heard
    double freshness = 0.0; // of that word, 0 to 1
    bool yields = false;    // at rest, this peer takes the other's pose (the higher id)
};

/// The paper's hybrid algorithm, without any compensation of delay:
/// - this hand touches at some time of the tick: the body moves by this copy's own dynamics under
///   the sum of the local contact force and the remote one as last received (the stronger decides
///   the direction);
/// - only the other hand touches: the body is where the other side last said (absolute, so that
///   nothing accumulates);
/// - nobody touches: the body coasts; 200 ms later the higher id blends to the lower id's pose
///   within 100 ms, so that the copies agree again.
class BaseAlgorithm {
public:
    static constexpr base::Duration settle_after{std::chrono::milliseconds{200}};
    static constexpr base::Duration settle_within{std::chrono::milliseconds{100}};

    /// Moves the world by one tick and says what this hand did in it; `from_remote` is what
    /// remote_force() says of the situation.
    [[nodiscard]] scene::HipTouch tick(scene::World& world, const Situation& situation,
                                       base::Force from_remote);

private:
    void settle(scene::World& world, const Situation& situation);

    struct Blend {
        base::TimePoint start;
        base::Position from;
    };
    std::optional<base::TimePoint> untouched_since_;
    std::optional<Blend> blend_;
};

/// The force of the remote hand on the body that counts now: as last received, faded with age,
/// and never more than a contact of this scene can exert.
[[nodiscard]] base::Force remote_force(const Situation& situation, double force_max_n);
/// Whether the remote hand counts as touching.
[[nodiscard]] bool remote_touching(const Situation& situation);

} // namespace hapnet::peer

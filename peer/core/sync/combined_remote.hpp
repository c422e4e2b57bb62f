// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/base_options.hpp"
#include "peer/core/sync/situation.hpp"

namespace hapnet::peer {

/// The others as an algorithm shows them to the paper's law: all of them as if they were one.
struct CombinedRemote {
    struct Pose {
        base::Position position;
        base::Velocity velocity;
    };

    bool heard = false;    // at least one state is neither stale nor older than let_go_after
    bool touching = false; // at least one of these hands touches the body
    base::Force force;     // sum of the forces of the touching hands on the body
    /// The body's pose, also from a stale state: the average of those who touch the body, otherwise
    /// the pose of the peer with the lowest id. nullopt: no pose was heard.
    std::optional<Pose> pose;
};

/// Returns the other hands as they were last heard. Their forces fade with age, and none exceeds
/// the greatest force of a contact.
[[nodiscard]] CombinedRemote combined_remote(const Situation& situation,
                                             const BaseOptions& options);

/// The part of a remote force that acts.
[[nodiscard]] base::Force along(base::Force force, Axes axes);

} // namespace hapnet::peer

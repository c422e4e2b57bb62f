// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/base_options.hpp"
#include "peer/core/sync/situation.hpp"

namespace hapnet::peer {

/// The other hands as an algorithm presents them to the paper's law, which treats them as one.
struct CombinedRemote {
    struct Pose {
        base::Position position;
        base::Velocity velocity;
    };

    bool heard = false;    // at least one state is neither stale nor older than let_go_after
    bool touching = false; // at least one of these hands touches the body
    base::Force force;     // sum of the forces of the touching hands on the body
    /// The body's pose, even from a stale state: the average over the peers that touch the body,
    /// otherwise the pose of the peer with the lowest id. nullopt: no pose was received.
    std::optional<Pose> pose;
};

/// Returns the other hands by their last received states. Their forces fade with age, and none
/// exceeds the greatest force of a contact.
[[nodiscard]] CombinedRemote combined_remote(const Situation& situation,
                                             const BaseOptions& options);

/// Returns the part of a remote force along the axes on which it acts.
[[nodiscard]] base::Force along(base::Force force, Axes axes);

} // namespace hapnet::peer

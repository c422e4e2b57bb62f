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

    bool heard = false;       // the state of one is neither stale nor let go
    bool touching = false;    // the hand of one touches the body
    base::Force force;        // of those hands on the body, their sum; zero when none touches
    std::optional<Pose> pose; // of the body, also when the state is stale: on average where those
                              // who touch have it, otherwise where the lowest id has it
};

/// Returns the other hands as they were last heard. Their forces fade with age, and none exceeds
/// the greatest force of a contact.
[[nodiscard]] CombinedRemote combined_remote(const Situation& situation,
                                             const BaseOptions& options);

/// The part of a remote force that acts.
[[nodiscard]] base::Force along(base::Force force, Axes axes);

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/base_options.hpp"
#include "peer/core/sync/situation.hpp"

namespace hapnet::peer {

/// The other side as an algorithm shows it to the paper's law.
struct Presence {
    struct Pose {
        base::Position position;
        base::Velocity velocity;
    };

    bool heard = false;       // its state is neither stale nor let go
    bool touching = false;    // its hand touches the body
    base::Force force;        // of that hand on the body; zero when it does not touch
    std::optional<Pose> pose; // of its body, also when its state is stale
};

/// As it was last heard: faded with age, and with no more force than a contact can exert.
[[nodiscard]] Presence presence_of(const Situation& situation, const BaseOptions& options);

/// The part of a remote force that acts.
[[nodiscard]] base::Force along(base::Force force, Axes axes);

} // namespace hapnet::peer

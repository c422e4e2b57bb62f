// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/combined_remote.hpp"

#include <optional>

namespace hapnet::peer {

/// Makes copies agree again when no hand touches the body. After some time, the copy that yields
/// moves its body on a straight line to the place in the remote's copy.
class AtRest {
public:
    struct Times {
        std::optional<base::Duration> after; // wait after all hands have let go; nullopt: never
        base::Duration within{};             // duration of the motion
    };

    /// Call it while a hand touches the body. Restarts the wait.
    void interrupt()
    {
        untouched_since_.reset();
        blend_.reset();
    }
    /// Returns the default times of base.
    [[nodiscard]] static Times usual()
    {
        const BaseOptions base;
        return {base.settle_after, base.settle_within};
    }
    /// True if no hand has touched the body for so long that copies that yield move to the others'.
    [[nodiscard]] bool has_waited(base::TimePoint now, const Times& times = usual()) const
    {
        return untouched_since_ && times.after && now - *untouched_since_ >= *times.after;
    }
    /// Returns the pose for a body that no hand touches; nullopt: do not move the body.
    [[nodiscard]] std::optional<CombinedRemote::Pose> pose(base::Position body,
                                                           const CombinedRemote& remote,
                                                           const Situation& situation,
                                                           const Times& times = usual());

private:
    struct Blend {
        base::TimePoint start;
        base::Position from;
    };
    std::optional<base::TimePoint> untouched_since_;
    std::optional<Blend> blend_;
};

} // namespace hapnet::peer

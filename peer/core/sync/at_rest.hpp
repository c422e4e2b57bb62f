// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/combined_remote.hpp"

#include <optional>

namespace hapnet::peer {

/// Makes copies agree again once no hand touches the body. Some time later, the copy that yields
/// moves it on a straight line to where the remote has it.
class AtRest {
public:
    struct Times {
        std::optional<base::Duration> after; // wait after all hands have let go; nullopt: never
        base::Duration within{};             // duration of the motion
    };

    /// A hand touches the body.
    void interrupt()
    {
        untouched_since_.reset();
        blend_.reset();
    }
    /// The times of base, by default.
    [[nodiscard]] static Times usual()
    {
        const BaseOptions base;
        return {base.settle_after, base.settle_within};
    }
    /// True if nothing has touched it for so long that copies that yield move to the others'.
    [[nodiscard]] bool has_waited(base::TimePoint now, const Times& times = usual()) const
    {
        return untouched_since_ && times.after && now - *untouched_since_ >= *times.after;
    }
    /// Returns the place for a body that no hand touches; nullopt: leave the body alone.
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

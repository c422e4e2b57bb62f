// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/at_rest.hpp"

namespace hapnet::peer {

std::optional<CombinedRemote::Pose> AtRest::pose(base::Position body, const CombinedRemote& remote,
                                                 const Situation& situation, const Times& times)
{
    if (!untouched_since_) untouched_since_ = situation.now;
    const bool waited = has_waited(situation.now, times);
    if (!situation.yields || !waited || !remote.pose || situation.remote.freshness() <= 0.0) {
        blend_.reset();
        return std::nullopt;
    }
    if (!blend_) blend_ = Blend{situation.now, body};
    const base::Duration since = situation.now - blend_->start;
    const double share =
        since < times.within ? base::to_seconds(since) / base::to_seconds(times.within) : 1.0;
    return CombinedRemote::Pose{blend_->from + share * (remote.pose->position - blend_->from),
                                remote.pose->velocity};
}

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/ownership.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>

namespace hapnet::peer {

void Ownership::touch(BodySet bodies, std::uint16_t peer, base::TimePoint now)
{
    const auto is_its = [peer](const Peer& each) { return each.id == peer || each.id == 0; };
    auto* const its = std::find_if(peers_.begin(), peers_.end(), is_its);
    if (its == peers_.end()) return; // more peers than a session has
    its->id = peer;
    for (std::size_t i = 0; i < its->touched.size(); ++i)
        if ((bodies >> i & 1U) != 0) its->touched[i] = now;
}

std::optional<base::TimePoint> Ownership::last_touch(BodySet bodies, std::uint16_t id) const
{
    std::optional<base::TimePoint> last;
    for (const Peer& peer : peers_) {
        if (peer.id != id) continue;
        for (std::size_t i = 0; i < peer.touched.size(); ++i)
            if ((bodies >> i & 1U) != 0) last = std::max(last, peer.touched[i]);
    }
    return last;
}

std::uint16_t Ownership::owner(BodySet bodies, std::span<const std::uint16_t> present,
                               base::TimePoint now) const
{
    base::ensure(!present.empty());
    std::optional<base::TimePoint> latest;
    for (const std::uint16_t id : present) latest = std::max(latest, last_touch(bodies, id));
    if (!latest || now - *latest >= lasts) return present.front();
    for (const std::uint16_t id : present) {
        const auto touched = last_touch(bodies, id);
        if (touched && *latest - *touched < same_time) return id;
    }
    return present.front();
}

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/state.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace hapnet::web {
namespace {

PeerState peer_of(unsigned id)
{
    PeerState peer{.socket = "s", .is_attached = true};
    if (id > 0) peer.shown = {{"peer_id", id}};
    return peer;
}

TEST(WebState, CallsPeersByTheirLettersOnceAllIdsAreKnown)
{
    const std::vector<PeerState> all{peer_of(1), peer_of(2), peer_of(7)};
    EXPECT_EQ(name_of_peer(all, 0), "A");
    EXPECT_EQ(name_of_peer(all, 2), "C");
    const std::vector<PeerState> some{peer_of(0), peer_of(2)};
    EXPECT_EQ(name_of_peer(some, 1), "peer 2");
}

} // namespace
} // namespace hapnet::web

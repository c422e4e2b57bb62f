// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "tests/support/session/attacked_session.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace hapnet::test {

/// What became of a session of several peers in trouble.
struct TroubledGroup {
    std::optional<std::string> complaint; // the invariant that broke, when, and where
    std::uint64_t datagrams = 0;          // that reached a side
    bool compared = false;                // the copies were, with all hands off
};

/// Plays T7 with two to eight peers over links that lose up to 30 % and delay by 40 ms +- 10 ms;
/// one of them is killed every few seconds and started again, and the last may come late. Four and
/// more may have begun in two halves that cannot hear each other until later. Judges
/// each tick: forces finite and limited; 300 ms after the last message of a killed peer no other
/// counts its hand any more, and if it was touching, the others feel nothing until it counts as
/// gone. At the end of hands off all copies of the body are within 0.1 mm.
[[nodiscard]] TroubledGroup play_troubled_group(std::uint64_t seed, std::size_t peers, Seal seal);

} // namespace hapnet::test

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::test {

/// What became of a session under attack.
struct AttackedSession {
    std::optional<std::string> complaint; // the invariant that broke, when, and where
    std::uint64_t datagrams = 0;          // that reached a side
    double work_5s_max_j = 0.0;           // the largest net work into a hand within 5 s
    bool compared = false;                // the copies were, after the attacker had left
    /// Without a key nothing tells forged and damaged messages from true ones: they may end a
    /// session, or keep it from beginning. Then there is nothing to compare. Never with keys.
    bool is_forged = false;
};

/// The seal of messages: none, keys of each side's own, or these with a shared key.
enum class Seal : std::uint8_t { none, own, keys };
[[nodiscard]] constexpr std::string_view name_of(Seal seal)
{
    if (seal == Seal::none) return "none";
    return seal == Seal::own ? "own" : "keys";
}
[[nodiscard]] constexpr bool is_keyed(Seal seal) { return seal != Seal::none; }

/// Plays a session whose path, tasks, algorithms, clocks, deaths and attacker are drawn from the
/// seed, and judges it in each tick: forces finite, limited, and zero once nothing was taken for
/// 300 ms; the work into the hands within its budget; each message that a side was given in exactly
/// one of its counters; and, with the attacker gone and the path healed, copies that agree to
/// 0.1 mm within 1.2 s of hands off. With keys also: nothing is accepted that the other side has
/// not sealed for this run, nothing twice, opening takes no memory, and a side multiplies on the
/// curve at most once in a tick.
///
/// More than two carry together (T7), with a link of its own between any two, and the attacker on
/// all of them; he also sends to one pair what another has said. Judged as well: a hand that was
/// not heard for 300 ms counts no more, and while it may be on the body the others feel nothing.
[[nodiscard]] AttackedSession play_attacked(std::uint64_t seed, Seal seal, std::size_t peers = 2);

} // namespace hapnet::test

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/wire/message.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::peer {

/// A set of shared bodies: bit i stands for the i-th.
using BodySet = std::uint8_t;
static_assert(wire::bodies_max <= 8);

/// Decides whose copy of a body the others take over while no hand moves it. At first it is the
/// copy of the peer whose hand moved it last, which saw the motion begin without a delay. Some time
/// later it is that of the lowest id, on which all agree whatever messages they received. Peers
/// that moved it at nearly the same time cannot all know which was the last, so among those it is
/// the lowest id at once.
class Ownership {
public:
    /// Touches that are less than this apart count as simultaneous. The time is longer than two
    /// messages take.
    static constexpr base::Duration same_time{std::chrono::milliseconds{500}};
    /// The time from a touch during which the copy of the last toucher is authoritative.
    static constexpr base::Duration lasts{std::chrono::seconds{1}};

    /// Notes that a peer's hand moves these bodies.
    void touch(BodySet bodies, std::uint16_t peer, base::TimePoint now);

    /// Returns the owner of bodies that touch each other. `present` has the ids of the possible
    /// owners, ascending, at least one.
    [[nodiscard]] std::uint16_t owner(BodySet bodies, std::span<const std::uint16_t> present,
                                      base::TimePoint now) const;

private:
    struct Peer {
        std::uint16_t id = 0; // 0: unused entry
        std::array<std::optional<base::TimePoint>, wire::bodies_max> touched{};
    };
    static constexpr std::size_t peers_max = 8;

    [[nodiscard]] std::optional<base::TimePoint> last_touch(BodySet bodies, std::uint16_t id) const;

    std::array<Peer, peers_max> peers_;
};

} // namespace hapnet::peer

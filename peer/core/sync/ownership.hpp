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

/// A set of shared bodies: bit i is the i-th.
using BodySet = std::uint8_t;
static_assert(wire::bodies_max <= 8);

/// Says whose copy of a body the others take over while no hand moves it: that of the peer whose
/// hand moved it last, since it has seen the motion begin without a delay; and some time later that
/// of the lowest id, on which all agree whatever they have heard. Peers that moved it at nearly the
/// same time cannot all know who was the last: of those it is the lowest id at once.
class Ownership {
public:
    /// Touches so near each other count as at the same time: more than two messages take.
    static constexpr base::Duration same_time{std::chrono::milliseconds{500}};
    /// How long the last one's copy counts, from that touch on.
    static constexpr base::Duration lasts{std::chrono::seconds{1}};

    /// A peer's hand moves these bodies.
    void touch(BodySet bodies, std::uint16_t peer, base::TimePoint now);

    /// Of bodies that touch each other. `present`: the ids that may own, of which there is at least
    /// one, ascending.
    [[nodiscard]] std::uint16_t owner(BodySet bodies, std::span<const std::uint16_t> present,
                                      base::TimePoint now) const;

private:
    struct Peer {
        std::uint16_t id = 0; // 0: none
        std::array<std::optional<base::TimePoint>, wire::bodies_max> touched{};
    };
    static constexpr std::size_t peers_max = 8;

    [[nodiscard]] std::optional<base::TimePoint> last_touch(BodySet bodies, std::uint16_t id) const;

    std::array<Peer, peers_max> peers_;
};

} // namespace hapnet::peer

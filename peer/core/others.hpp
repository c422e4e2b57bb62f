// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/remote.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace hapnet::peer {

/// The largest number of peers in a session, this one included.
inline constexpr std::size_t peers_max = 8;

/// The other peers of a peer.
struct Roster {
    /// The ids of the others, ascending. A single 0 stands for any peer that answers.
    std::vector<std::uint16_t> others{0};
    /// The number of peers, this one included, that must hear each other before they start; 0: all.
    std::size_t wait_for = 0;
};

/// The other peers of a session. Two peers agree on a start by their handshake. Among more peers,
/// the one with the lowest id sets the start as soon as all that are waited for hear each other.
/// Each peer that knows the start sends it to the peers that it meets; these join the session if it
/// has begun. If peers that meet have different starts, because they began separately, the earlier
/// one counts and the others join it.
class Others {
public:
    /// With more than two peers, the time for which a peer counts as heard after its last hello.
    static constexpr base::Duration hello_lasts{std::chrono::seconds{1}};
    /// With more than two peers, the silence after which a peer counts as gone until it is heard
    /// again, while the others play on. During the silence its hand may still be on the body.
    static constexpr base::Duration gone_after{std::chrono::seconds{1}};

    /// The id in the introduction must not be one of the others' ids.
    Others(const Roster& roster, const Remote::Config& each);

    [[nodiscard]] std::span<Remote> all() { return all_; }
    [[nodiscard]] std::span<const Remote> all() const { return all_; }
    [[nodiscard]] Remote& operator[](std::size_t index) { return all_[index]; }
    [[nodiscard]] std::size_t size() const { return all_.size(); }
    /// True if this peer plays with exactly one other.
    [[nodiscard]] bool is_pair() const { return all_.size() == 1; }

    /// Call it after a hello of the remote `of`. Checks if all peers can start, and sends a known
    /// start to those that do not know it.
    void after_hello(std::size_t of, base::TimePoint now);
    /// Sends hellos to the peers for which they are due.
    void say_hello(base::TimePoint now);

    /// Begins a tick. Returns the freshness of the newest state of all.
    double look(base::TimePoint now);
    /// Returns the remote with the lowest id among those that are heard now, or, if none is heard,
    /// among those that were heard before.
    [[nodiscard]] const Remote& leader() const;
    /// True if enough is known about the others for their forces to act: at least one is fresh, and
    /// so are all whose hands may be on the body.
    [[nodiscard]] bool are_fresh(base::TimePoint now) const;
    /// True if all of the others have said goodbye.
    [[nodiscard]] bool are_gone() const { return std::ranges::all_of(all_, &Remote::is_gone); }

    /// Returns the start, seed and length that all peers have in common. Its number and side are
    /// valid only in a pair. With more peers each pair has its own number, see Remote::session(),
    /// and rank() replaces the side.
    [[nodiscard]] const std::optional<Session>& session() const
    {
        return is_pair() ? all_.front().session() : agreed_;
    }
    /// Returns the rank of this peer among all peers sorted by id, from 0. In a pair with an
    /// unknown other peer, it is 0 until that peer is met.
    [[nodiscard]] std::size_t rank() const;

private:
    [[nodiscard]] std::uint32_t heard(base::TimePoint now) const;
    [[nodiscard]] bool can_start(base::TimePoint now) const;
    [[nodiscard]] bool hear_each_other(const Remote& a, const Remote& b) const;

    Introduction self_;
    std::size_t wait_for_;
    std::vector<Remote> all_;
    std::optional<Session> agreed_; // session of more than two peers
};

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/remote.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace hapnet::peer {

/// Peers of one session, this one among them, at most.
inline constexpr std::size_t peers_max = 8;

/// The peers with which a peer plays.
struct Roster {
    /// The others' ids, ascending; 0 stands for any peer that answers, and then for the only one.
    std::vector<std::uint16_t> others{0};
    /// The number of peers, this one counted, that must hear each other before they start; 0: all
    /// of them.
    std::size_t wait_for = 0;
};

/// The other peers of a session. Two peers agree on a start by their handshake. Among more peers
/// the lowest id sets the start, as soon as all that are waited for hear each other. Each peer that
/// knows the start tells it to the peers that it meets, which join the session if it has begun. If
/// peers that meet know two starts, because they began apart, the earlier one counts and the others
/// join it.
class Others {
public:
    /// With more than two peers, the time after its last hello for which a peer counts as heard.
    static constexpr base::Duration hello_lasts{std::chrono::seconds{1}};
    /// With more than two peers, the silence after which a peer counts as gone until it is heard
    /// again, and the others play on. During the silence its hand may still be on the body.
    static constexpr base::Duration gone_after{std::chrono::seconds{1}};

    /// The introduction's id must not be one of the others'.
    Others(const Roster& roster, const Remote::Config& each);

    [[nodiscard]] std::span<Remote> all() { return all_; }
    [[nodiscard]] std::span<const Remote> all() const { return all_; }
    [[nodiscard]] Remote& operator[](std::size_t index) { return all_[index]; }
    [[nodiscard]] std::size_t size() const { return all_.size(); }
    /// This peer plays with one other.
    [[nodiscard]] bool is_pair() const { return all_.size() == 1; }

    /// Call it after a hello of the remote `of`. Checks if all can start, and tells a known start
    /// to those who do not know it.
    void after_hello(std::size_t of, base::TimePoint now);
    /// Says hello to those to whom it is due.
    void say_hello(base::TimePoint now);

    /// Begins a tick; returns the freshness of the newest state of all.
    double look(base::TimePoint now);
    /// The peer with the lowest id of those that are heard now. If none is, that of those heard
    /// before.
    [[nodiscard]] const Remote& leader() const;
    /// True if what they do is known well enough for a hand to feel it: one of them is fresh, and
    /// so are all whose hands may be on the body.
    [[nodiscard]] bool are_fresh(base::TimePoint now) const;
    /// True if all of them said goodbye.
    [[nodiscard]] bool are_gone() const { return std::ranges::all_of(all_, &Remote::is_gone); }

    /// The start, seed and length that all have in common. Its number and side are of use in a pair
    /// alone: among more each has its own, see Remote::session() and rank().
    [[nodiscard]] const std::optional<Session>& session() const
    {
        return is_pair() ? all_.front().session() : agreed_;
    }
    /// The place of this peer among all in the order of their ids, from 0. In a pair with an
    /// unknown other one: 0 until it is met.
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

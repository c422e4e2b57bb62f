// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/member.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace hapnet::peer {

/// Peers of one session, this one among them, at most.
inline constexpr std::size_t circle_max = 8;

/// Whom a peer plays with.
struct Roster {
    /// The others' ids, ascending; 0 stands for whoever answers, and then for the only one.
    std::vector<std::uint16_t> others{0};
    /// So many peers, this one counted, must hear each other before they start; 0: all of them.
    std::size_t wait_for = 0;
};

/// The others of a session. Two agree on a start by their handshake. Among more the lowest id sets
/// it, as soon as all that are waited for hear each other; everyone who knows it tells it to those
/// that it meets, who join if it has begun. Where those that meet know two starts, because their
/// circles began apart, the earlier one counts and the others join it.
class Circle {
public:
    /// With more than two peers, one whose hellos stopped so long ago is not heard any more.
    static constexpr base::Duration hello_lasts{std::chrono::seconds{1}};

    /// The introduction's id must not be one of the others'.
    Circle(const Roster& roster, const Member::Config& each);

    [[nodiscard]] std::span<Member> members() { return members_; }
    [[nodiscard]] std::span<const Member> members() const { return members_; }
    [[nodiscard]] bool is_pair() const { return members_.size() == 1; }

    /// After a hello of member `of`: looks whether all can start, and tells a start that is known
    /// to those who do not know it.
    void after_hello(std::size_t of, base::TimePoint now);
    /// Says hello to those to whom it is due.
    void say_hello(base::TimePoint now);

    /// The start, seed and length that all have in common. Its number and side are of use in a pair
    /// alone: among more each member has its own, see Member::session() and rank().
    [[nodiscard]] const std::optional<Session>& session() const;
    /// The place of this peer among all in the order of their ids, from 0. In a pair with an
    /// unknown other one: 0 until it is met.
    [[nodiscard]] std::size_t rank() const;

private:
    [[nodiscard]] std::uint32_t heard(base::TimePoint now) const;
    [[nodiscard]] bool can_start(base::TimePoint now) const;
    [[nodiscard]] bool hear_each_other(const Member& a, const Member& b) const;

    Introduction self_;
    std::size_t wait_for_;
    std::vector<Member> members_;
    std::optional<Session> agreed_; // among more than two
};

} // namespace hapnet::peer

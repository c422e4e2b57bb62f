// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/circle.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>

namespace hapnet::peer {

namespace {

/// Ids above 31 have no bit: only those of a pair may be.
std::uint32_t bit_of(std::uint16_t id) { return id < 32 ? std::uint32_t{1} << id : 0; }

} // namespace

Circle::Circle(const Roster& roster, const Member::Config& each)
    : self_{each.introduction},
      wait_for_{roster.wait_for == 0 ? roster.others.size() + 1 : roster.wait_for}
{
    base::ensure(!roster.others.empty() && roster.others.size() < circle_max);
    members_.reserve(roster.others.size());
    for (const std::uint16_t id : roster.others) {
        Member::Config config = each;
        config.id = id;
        if (roster.others.size() > 1) {
            base::ensure(id != 0 && id != self_.id);
            config.start_set_by = Handshake::StartSetBy::circle;
        }
        members_.emplace_back(config);
    }
}

const std::optional<Session>& Circle::session() const
{
    return is_pair() ? members_.front().session() : agreed_;
}

std::size_t Circle::rank() const
{
    return static_cast<std::size_t>(std::ranges::count_if(members_, [&](const Member& member) {
        return member.id() != 0 && member.id() < self_.id;
    }));
}

std::uint32_t Circle::heard(base::TimePoint now) const
{
    std::uint32_t bits = 0;
    for (const Member& member : members_) {
        if (!member.handshake().has_met()) continue;
        if (is_pair() || member.is_heard_within(hello_lasts, now))
            bits |= bit_of(member.handshake().id());
    }
    return bits;
}

bool Circle::hear_each_other(const Member& a, const Member& b) const
{
    return (a.handshake().heard_there() & bit_of(b.id())) != 0 &&
           (b.handshake().heard_there() & bit_of(a.id())) != 0;
}

/// Whether this peer is to set the start: those that it waits for hear each other, and it has the
/// lowest id of them.
bool Circle::can_start(base::TimePoint now) const
{
    std::size_t present = 1;
    for (const Member& member : members_) {
        if (!member.handshake().is_heard_there() || !member.is_heard_within(hello_lasts, now))
            continue;
        ++present;
        if (member.id() < self_.id) return false;
        for (const Member& other : members_) {
            const bool is_there =
                other.handshake().is_heard_there() && other.is_heard_within(hello_lasts, now);
            if (&other != &member && is_there && !hear_each_other(member, other)) return false;
        }
    }
    return present >= wait_for_;
}

void Circle::after_hello(std::size_t of, base::TimePoint now)
{
    if (is_pair()) return;
    const bool late = agreed_.has_value();
    if (!agreed_) {
        if (const auto& told = members_[of].session()) {
            agreed_ = told;
        } else if (can_start(now)) {
            base::Duration length = self_.length;
            for (const Member& member : members_)
                length = std::min(length, member.handshake().length());
            agreed_ = Session{
                .start = now + Handshake::start_after, .seed = self_.seed, .length = length};
        }
    }
    if (!agreed_) return;
    if (const auto& earlier = members_[of].handshake().earlier()) agreed_ = earlier;
    for (Member& member : members_) {
        const bool knows_it = member.session() && member.session()->start == agreed_->start;
        if (member.handshake().has_met() && !knows_it) member.join(*agreed_, late, now);
    }
}

void Circle::say_hello(base::TimePoint now)
{
    for (Member& member : members_) {
        if (!member.handshake().is_hello_due(now)) continue;
        if (const auto hello = member.handshake().hello(now, heard(now))) member.post(*hello);
    }
}

} // namespace hapnet::peer

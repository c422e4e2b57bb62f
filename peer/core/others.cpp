// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/others.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>

namespace hapnet::peer {

namespace {

/// Ids above 31 have no bit. They are possible only in a pair.
std::uint32_t bit_of(std::uint16_t id) { return id < 32 ? std::uint32_t{1} << id : 0; }

} // namespace

Others::Others(const Roster& roster, const Remote::Config& each)
    : self_{each.introduction},
      wait_for_{roster.wait_for == 0 ? roster.others.size() + 1 : roster.wait_for}
{
    base::ensure(!roster.others.empty() && roster.others.size() < peers_max);
    all_.reserve(roster.others.size());
    for (const std::uint16_t id : roster.others) {
        Remote::Config config = each;
        config.id = id;
        if (roster.others.size() > 1) {
            base::ensure(id != 0 && id != self_.id);
            config.start_set_by = Handshake::StartSetBy::session;
        }
        all_.emplace_back(config);
    }
}

std::size_t Others::rank() const
{
    return static_cast<std::size_t>(std::ranges::count_if(
        all_, [&](const Remote& remote) { return remote.id() != 0 && remote.id() < self_.id; }));
}

std::uint32_t Others::heard(base::TimePoint now) const
{
    std::uint32_t bits = 0;
    for (const Remote& remote : all_) {
        if (!remote.handshake().has_met()) continue;
        if (is_pair() || remote.is_heard_within(hello_lasts, now))
            bits |= bit_of(remote.handshake().id());
    }
    return bits;
}

bool Others::hear_each_other(const Remote& a, const Remote& b) const
{
    return (a.handshake().heard_there() & bit_of(b.id())) != 0 &&
           (b.handshake().heard_there() & bit_of(a.id())) != 0;
}

/// True if this peer has to set the start: the peers that it waits for hear each other, and it has
/// the lowest id of them.
bool Others::can_start(base::TimePoint now) const
{
    std::size_t present = 1;
    for (const Remote& remote : all_) {
        if (!remote.handshake().is_heard_there() || !remote.is_heard_within(hello_lasts, now))
            continue;
        ++present;
        if (remote.id() < self_.id) return false;
        for (const Remote& other : all_) {
            const bool is_there =
                other.handshake().is_heard_there() && other.is_heard_within(hello_lasts, now);
            if (&other != &remote && is_there && !hear_each_other(remote, other)) return false;
        }
    }
    return present >= wait_for_;
}

void Others::after_hello(std::size_t of, base::TimePoint now)
{
    if (is_pair()) return;
    const bool late = agreed_.has_value();
    if (!agreed_) {
        if (const auto& told = all_[of].session()) {
            agreed_ = told;
        } else if (can_start(now)) {
            base::Duration length = self_.length;
            for (const Remote& remote : all_)
                length = std::min(length, remote.handshake().length());
            agreed_ = Session{
                .start = now + Handshake::start_after, .seed = self_.seed, .length = length};
        }
    }
    if (!agreed_) return;
    if (const auto& earlier = all_[of].handshake().earlier()) agreed_ = earlier;
    for (Remote& remote : all_) {
        const bool knows_it = remote.session() && remote.session()->start == agreed_->start;
        if (remote.handshake().has_met() && !knows_it) remote.join(*agreed_, late, now);
    }
}

double Others::look(base::TimePoint now)
{
    double freshest = 0.0;
    for (Remote& remote : all_) {
        remote.look(now);
        freshest = std::max(freshest, remote.freshness());
    }
    return freshest;
}

const Remote& Others::leader() const
{
    if (is_pair()) return all_.front();
    const auto is_heard = [](const Remote& remote) { return remote.freshness() > 0.0; };
    const auto was_heard = [](const Remote& remote) { return remote.body() != nullptr; };
    auto found = std::ranges::find_if(all_, is_heard);
    if (found == all_.end()) found = std::ranges::find_if(all_, was_heard);
    return found == all_.end() ? all_.front() : *found;
}

bool Others::are_fresh(base::TimePoint now) const
{
    if (is_pair()) return all_.front().freshness() >= 1.0;
    bool any = false;
    for (const Remote& remote : all_) {
        if (remote.freshness() >= 1.0) {
            any = true;
        } else if (!remote.counts_as_gone(gone_after, now)) {
            if (remote.state() && remote.state()->touching) return false;
        }
    }
    return any;
}

void Others::say_hello(base::TimePoint now)
{
    for (Remote& remote : all_) {
        if (!remote.handshake().is_hello_due(now)) continue;
        if (const auto hello = remote.handshake().hello(now, heard(now))) remote.post(*hello);
    }
}

} // namespace hapnet::peer

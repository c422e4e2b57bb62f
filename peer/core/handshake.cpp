// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/handshake.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <limits>

namespace hapnet::peer {

namespace {

// The longest session that can be requested is 10^6 s. A start that is farther away is invalid.
constexpr base::Duration start_away_max{std::chrono::seconds{1'000'001}};

// The most by which a stamp may be ahead of the previous message's.
constexpr base::Duration ahead_max{std::chrono::seconds{10}};
// The time without a newer message after which the next one counts as the newest, whatever its
// stamp is, because a clock must have jumped.
constexpr base::Duration newest_for{std::chrono::seconds{1}};

/// Rounds up, and never returns 0, which would mean that no length is given.
std::uint32_t in_milliseconds(base::Duration length)
{
    const auto whole = std::chrono::ceil<std::chrono::milliseconds>(length).count();
    return static_cast<std::uint32_t>(
        std::clamp<std::int64_t>(whole, 1, std::numeric_limits<std::uint32_t>::max()));
}

} // namespace

std::optional<wire::ByeReason> Handshake::refusal_of(const wire::Hello& hello) const
{
    if (hello.peer_id == self_.id) return wire::ByeReason::same_id;
    if (hello.scene_hash != self_.scene_hash) return wire::ByeReason::other_scene;
    if (!(hello.task == self_.task)) return wire::ByeReason::other_task;
    if (hello.tick_rate_hz != self_.tick_rate_hz) return wire::ByeReason::other_tick_rate;
    return std::nullopt;
}

std::optional<wire::ByeReason> Handshake::on_hello(const wire::Hello& hello,
                                                   base::TimePoint arrived, Known known)
{
    const bool is_our_own = hello.nonce == self_.nonce && hello.peer_id == self_.id;
    if (is_our_own) return std::nullopt; // our own hello came back
    if (const auto reason = refusal_of(hello)) return reason;
    const bool is_of_another_run = !remote_ || remote_->nonce != hello.nonce;
    if (is_of_another_run && remote_ && known == Known::heard) return std::nullopt;
    if (is_of_another_run) {
        meet(hello);
        met_at_ = arrived;
    }
    remote_->hears_us = hello.nonce_heard == self_.nonce;
    remote_->heard = hello.heard;
    remote_->length_ms = hello.length_ms;
    remote_->hand = hello.hand;
    if (hello.nonce_heard != self_.nonce) { // the remote has not heard this run of us yet
        asked_ = true;
        last_heard_ = wire::Echo{hello.sent, {}};
        last_heard_at_ = arrived;
        return std::nullopt;
    }
    on_echo(hello.echo, hello.sent, arrived);
    agree(hello, arrived);
    return std::nullopt;
}

void Handshake::meet(const wire::Hello& hello)
{
    remote_ = RemotePeer{.nonce = hello.nonce, .id = hello.peer_id};
    clock_.reset();
    // The other's clock may be off as much, the other way.
    if (hello.boot != 0 && hello.boot == self_.clock) clock_.set_same_clock(2 * self_.clock_error);
    last_heard_.reset();
    start_heard_.reset();
    other_start_.reset();
    starts_differ_ = false;
    earlier_.reset();
    acknowledged_ = false;
    if (!session_) return;
    // The remote was restarted. This peer continues and lets it join.
    session_->number = number();
    session_->is_left = is_left();
    session_->joined_late = false;
    owns_start_ = true;
    stayed_ = true;
}

bool Handshake::is_left() const { return self_.id < remote_->id; }

std::uint32_t Handshake::number() const
{
    return is_left() ? wire::session_number(self_.nonce, remote_->nonce)
                     : wire::session_number(remote_->nonce, self_.nonce);
}

void Handshake::agree(const wire::Hello& hello, base::TimePoint arrived)
{
    if (set_by_ == StartSetBy::session) return agree_with_all(hello, arrived);
    const bool ours_to_decide = owns_start_ || (is_left() && !hello.in_session);
    if (ours_to_decide) {
        if (!session_) propose(arrived + start_after);
        if (hello.start_heard == session_->start) acknowledged_ = true;
        asked_ = !acknowledged_;
    } else if (hello.start) {
        adopt(hello, arrived);
        asked_ = true; // the remote repeats its hello until this is acknowledged
    }
}

/// Both peers may know the start from others and announce it. Each acknowledges the other's start.
void Handshake::agree_with_all(const wire::Hello& hello, base::TimePoint arrived)
{
    if (!session_) {
        if (hello.start) adopt(hello, arrived);
        asked_ = true;
        return;
    }
    if (hello.start) compare_starts(hello, arrived);
    if (hello.start_heard == session_->start) acknowledged_ = true;
    const bool knows_a_former_one = hello.start_heard && hello.start_heard != session_->start;
    asked_ = !owns_start_ || !acknowledged_ || knows_a_former_one;
}

/// Detects if the remote is in another session that began separately: the starts then differ.
void Handshake::compare_starts(const wire::Hello& hello, base::TimePoint arrived)
{
    start_heard_ = hello.start;
    earlier_.reset();
    const auto later = later_there();
    starts_differ_ = later.has_value();
    if (!later || *later > base::Duration{0} || !has_come_often(*hello.start)) return;
    const base::TimePoint start = session_->start + *later;
    const bool is_over = arrived - start >= length();
    if (!is_over) earlier_ = Session{number(), start, hello.seed, length(), is_left(), true};
}

/// Returns the time by which the remote's start is later than the one known here; nullopt if they
/// are equal or cannot be compared.
std::optional<base::Duration> Handshake::later_there() const
{
    const auto there = clock();
    if (!start_heard_ || !there) return std::nullopt;
    const base::Duration later = *start_heard_ - there->offset - session_->start;
    if (is_same(later, there->uncertainty) || std::chrono::abs(later) > start_away_max)
        return std::nullopt;
    return later;
}

/// A peer in a session announces the agreed length, so the length does not change.
base::Duration Handshake::length() const
{
    if (!remote_ || remote_->length_ms == 0) return self_.length;
    return std::min<base::Duration>(self_.length, std::chrono::milliseconds{remote_->length_ms});
}

void Handshake::propose(base::TimePoint start)
{
    session_ = Session{number(), start, self_.seed, length(), is_left(), false};
    owns_start_ = true;
}

void Handshake::tell(const Session& agreed, bool late)
{
    base::ensure(remote_.has_value());
    const bool had_another = session_ && session_->start != agreed.start;
    session_ = agreed;
    session_->number = number();
    session_->is_left = is_left();
    owns_start_ = true;
    stayed_ = late;
    if (!had_another) return;
    earlier_.reset();
    starts_differ_ = !start_heard_ || later_there();
}

void Handshake::adopt(const wire::Hello& hello, base::TimePoint arrived)
{
    const auto clock = clock_.estimate();
    if (!clock || start_heard_ == hello.start) return;
    const base::TimePoint start = *hello.start - clock->offset;
    if (std::chrono::abs(start - arrived) > start_away_max) return;
    if (start_heard_ && !may_replace_start(*hello.start, arrived)) return;
    start_heard_ = hello.start;
    session_ = Session{number(), start, hello.seed, length(), is_left(), hello.in_session};
}

bool Handshake::may_replace_start(base::TimePoint start, base::TimePoint arrived)
{
    const bool has_begun = acknowledged_ || arrived >= session_->start;
    return !has_begun && has_come_often(start);
}

/// True if the remote has announced this start `starts_needed` times in a row.
bool Handshake::has_come_often(base::TimePoint start)
{
    if (other_start_ != start) {
        other_start_ = start;
        times_other_start_ = 0;
    }
    return ++times_other_start_ >= starts_needed;
}

void Handshake::on_echo(const std::optional<wire::Echo>& echo, base::TimePoint sent,
                        base::TimePoint arrived)
{
    if (echo) clock_.add({echo->of, sent - echo->age, sent, arrived});
    const auto is_next = [&] {
        const base::Duration passed = arrived - last_heard_at_;
        if (std::chrono::abs(passed) > newest_for) return true;
        // The remote's clock runs as fast as this one. A time far ahead is damaged, and no later
        // message could be newer.
        const base::Duration ahead = sent - last_heard_->of;
        return ahead > base::Duration{0} && ahead <= passed + ahead_max;
    };
    if (last_heard_ && !is_next()) return;
    last_heard_ = wire::Echo{sent, {}};
    last_heard_at_ = arrived;
}

std::optional<wire::Echo> Handshake::echo(base::TimePoint now) const
{
    if (!last_heard_) return std::nullopt;
    const base::Duration age = now - last_heard_at_;
    constexpr auto age_max = base::Duration{std::numeric_limits<std::uint32_t>::max()};
    if (age < base::Duration{0} || age > age_max) return std::nullopt;
    return wire::Echo{last_heard_->of, age};
}

std::optional<wire::Hello> Handshake::hello(base::TimePoint now, std::uint32_t heard)
{
    if (!is_hello_due(now)) return std::nullopt;
    last_hello_ = now;
    asked_ = false;
    wire::Hello hello;
    hello.nonce = self_.nonce;
    hello.nonce_heard = remote_ ? remote_->nonce : 0;
    hello.peer_id = self_.id;
    hello.tick_rate_hz = self_.tick_rate_hz;
    hello.scene_hash = self_.scene_hash;
    hello.seed = session_ ? session_->seed : self_.seed;
    hello.sent = now;
    hello.echo = echo(now);
    if (session_ && (owns_start_ || starts_differ_)) hello.start = session_->start;
    hello.start_heard = start_heard_;
    hello.in_session = stayed_;
    hello.task = self_.task;
    hello.length_ms = in_milliseconds(session_ ? session_->length : self_.length);
    hello.heard = heard;
    hello.boot = self_.clock;
    hello.hand = self_.hand;
    return hello;
}

} // namespace hapnet::peer

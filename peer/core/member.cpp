// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/member.hpp"

#include <algorithm>
#include <utility>

namespace hapnet::peer {

Member::Member(const Config& config)
    : id_{config.id},
      handshake_{config.introduction, config.start_set_by},
      remote_{config.staleness, config.stale},
      sequences_{config.tick},
      meter_{config.measures_path ? std::make_unique<PathMeter>() : nullptr},
      tick_{config.tick}
{}

Member::Greeting Member::on_hello(const wire::Hello& hello, base::TimePoint arrived)
{
    const bool had_met = handshake_.has_met();
    const bool had_session = session().has_value();
    const bool is_heard = had_session && !gone_ && remote_.freshness(arrived) >= 1.0;
    const auto known = is_heard ? Handshake::Known::heard : Handshake::Known::silent;
    if (const auto reason = handshake_.on_hello(hello, arrived, known)) {
        return {.refused = reason, .had_session = had_session};
    }
    last_heard_ = arrived;
    const bool is_new = session() && session()->number != current_.number;
    if (is_new) begin_session(arrived);
    return {
        .refused = std::nullopt, .met = !had_met, .in_session = is_new, .had_session = had_session};
}

void Member::begin_session(base::TimePoint now)
{
    // A late hello of an earlier run may make us change over and back: then count on.
    former_ = std::exchange(current_, session()->number == former_.number
                                          ? former_
                                          : Numbering{.number = session()->number});
    agreed_at_ = now;
    remote_.forget();
    sequences_.forget();
    if (meter_) *meter_ = PathMeter{};
    last_body_ = now;
    states_without_body_ = 0;
    gone_ = false;
    lost_ = false;
}

void Member::join(const Session& agreed, bool late, base::TimePoint now)
{
    handshake_.tell(agreed, late);
    if (session()->number != current_.number) begin_session(now);
}

bool Member::can_be_numbered(const wire::State& state, base::TimePoint arrived) const
{
    // One state a tick since the start; the slack is for clocks and starts that differ. A damaged
    // number that was believed would make all that follows look outdated.
    const auto ticks = std::max<base::Duration::rep>(0, (arrived - session()->start) / tick_);
    const auto most = static_cast<std::uint32_t>(
        std::min<base::Duration::rep>(ticks + sequence_slack, UINT32_MAX));
    return state.sequence <= most && sequences_.admits(state, arrived);
}

bool Member::takes_back_goodbye(const wire::State& state, base::TimePoint arrived)
{
    if (!goodbye_.last_sent) goodbye_.last_sent = state.sent;
    const bool goes_on = state.sent - *goodbye_.last_sent > goodbye_doubted_for &&
                         arrived - goodbye_.heard > goodbye_doubted_for;
    if (!goes_on) return false;
    gone_ = false;
    lost_ = true; // so that a person is told that it is back
    return true;
}

Member::Heard Member::on_state(const wire::State& state, base::TimePoint arrived)
{
    handshake_.on_state();
    handshake_.on_echo(state.echo, state.sent, arrived);
    last_heard_ = arrived;
    if (meter_) meter_->on_state(state, arrived, handshake_.clock());
    Heard heard{.taken = remote_.update(state, arrived)};
    const std::uint32_t jumps = handshake_.clock_sync().jumps();
    heard.clock_jumped = std::exchange(jumps_told_, jumps) < jumps;
    if (heard.taken) {
        sequences_.on_taken(state, arrived);
        heard.body_missed = misses_body(state, arrived);
    }
    return heard;
}

/// True once, when something on the path lets only the shorter messages through.
bool Member::misses_body(const wire::State& state, base::TimePoint arrived)
{
    if (!state.bodies.empty()) {
        last_body_ = arrived;
        states_without_body_ = 0;
        return false;
    }
    ++states_without_body_;
    const bool is_missed = states_without_body_ >= states_without_body_max &&
                           arrived - last_body_ >= body_missed_after;
    return is_missed && !std::exchange(body_missed_, true);
}

bool Member::on_goodbye(const wire::Bye& bye, base::TimePoint arrived)
{
    if (!session() || bye.session != current_.number || gone_) return false;
    gone_ = true;
    goodbye_ = {.heard = arrived, .last_sent = {}};
    if (remote_.state()) goodbye_.last_sent = remote_.state()->sent;
    return true;
}

Member::Change Member::look(base::TimePoint now, double freshness)
{
    if (gone_ || !session()) return Change::none;
    const bool may_be_on_its_way = now - std::max(session()->start, agreed_at_) < first_word_within;
    if (!remote_.arrived() && may_be_on_its_way) return Change::none;
    const bool lost = freshness <= 0.0;
    if (lost == lost_) return Change::none;
    lost_ = lost;
    return lost ? Change::lost : Change::back;
}

bool Member::counts_as_gone(base::Duration silence, base::TimePoint now) const
{
    if (gone_ || !session()) return true;
    return now - remote_.arrived().value_or(std::max(session()->start, agreed_at_)) > silence;
}

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/remote.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace hapnet::peer {

Remote::Remote(const Config& config)
    : staleness_{config.staleness},
      stale_{config.stale},
      id_{config.id},
      handshake_{config.introduction, config.start_set_by},
      sequences_{config.tick},
      meter_{config.measures_path ? std::make_unique<PathMeter>() : nullptr},
      playout_{config.playout == Playout::adaptive ? std::make_unique<PlayoutBuffer>() : nullptr},
      tick_{config.tick}
{}

Remote::Greeting Remote::on_hello(const wire::Hello& hello, base::TimePoint arrived)
{
    const bool had_met = handshake_.has_met();
    const bool had_session = session().has_value();
    const bool is_heard = had_session && freshness_at(arrived) >= 1.0;
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

void Remote::begin_session(base::TimePoint now)
{
    // A late hello of an earlier run may make this peer switch to it and back. Counting then
    // continues.
    former_ = std::exchange(current_, session()->number == former_.number
                                          ? former_
                                          : Numbering{.number = session()->number});
    agreed_at_ = now;
    forget_state();
    sequences_.forget();
    tick_count_.forget();
    if (meter_) *meter_ = PathMeter{};
    if (playout_) playout_->forget();
    last_body_ = now;
    states_without_body_ = 0;
    gone_ = false;
    lost_ = false;
}

void Remote::join(const Session& agreed, bool late, base::TimePoint now)
{
    handshake_.tell(agreed, late);
    if (session()->number != current_.number) begin_session(now);
}

bool Remote::can_be_numbered(const wire::State& state, base::TimePoint arrived) const
{
    // There is one state a tick since the start. The tolerance covers clocks and starts that
    // differ. If a damaged number were accepted, all later states would look outdated.
    const auto ticks = std::max<base::Duration::rep>(0, (arrived - session()->start) / tick_);
    const auto most = static_cast<std::uint32_t>(
        std::min<base::Duration::rep>(ticks + sequence_slack, UINT32_MAX));
    return state.sequence <= most && sequences_.admits(state, arrived);
}

bool Remote::takes_back_goodbye(const wire::State& state, base::TimePoint arrived)
{
    if (!goodbye_.last_sent) goodbye_.last_sent = state.sent;
    const bool goes_on = state.sent - *goodbye_.last_sent > goodbye_doubted_for &&
                         arrived - goodbye_.heard > goodbye_doubted_for;
    if (!goes_on) return false;
    gone_ = false;
    lost_ = true; // so that change() reports the remote as back
    return true;
}

bool Remote::on_arrival(const wire::State& state, base::TimePoint arrived)
{
    handshake_.on_state();
    handshake_.on_echo(state.echo, state.sent, arrived);
    last_heard_ = arrived;
    if (meter_) meter_->on_state(state, arrived, handshake_.clock());
    const std::uint32_t jumps = handshake_.clock_sync().jumps();
    return std::exchange(jumps_told_, jumps) < jumps;
}

Remote::Heard Remote::on_state(const wire::State& state, base::TimePoint at)
{
    Heard heard{.taken = update(state, at)};
    if (heard.taken) {
        sequences_.on_taken(state, at);
        heard.body_missed = misses_body(state, at);
    }
    return heard;
}

/// Returns true once, if something on the path lets only the shorter messages through.
bool Remote::misses_body(const wire::State& state, base::TimePoint arrived)
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

bool Remote::on_goodbye(const wire::Bye& bye, base::TimePoint arrived)
{
    if (!session() || bye.session != current_.number || gone_) return false;
    gone_ = true;
    goodbye_ = {.heard = arrived, .last_sent = {}};
    if (state_) goodbye_.last_sent = state_->sent;
    return true;
}

Remote::Change Remote::change(base::TimePoint now)
{
    if (gone_ || !session()) return Change::none;
    const bool may_be_on_its_way = now - first_word_awaited_since() < first_word_within;
    if (!arrived_ && may_be_on_its_way) return Change::none;
    const bool lost = freshness_ <= 0.0;
    if (lost == lost_) return Change::none;
    lost_ = lost;
    return lost ? Change::lost : Change::back;
}

bool Remote::counts_as_gone(base::Duration silence, base::TimePoint now) const
{
    if (gone_ || !session()) return true;
    return now - arrived_.value_or(first_word_awaited_since()) > silence;
}

bool Remote::update(const wire::State& state, base::TimePoint arrived)
{
    const bool is_stale = state_ && state.sequence <= state_->sequence;
    if (is_stale && stale_ == Stale::drop) return false;
    arrived_ = arrived_ ? std::max(*arrived_, arrived) : arrived;
    state_ = state;
    if (count_ == 1 && state.bodies.size() == 1 && bodies_[0].body == state.bodies.first()->body) {
        bodies_[0] = *state.bodies.first(); // shortcut for one body, as in the paper's scene
    } else {
        take_bodies(state);
    }
    return true;
}

void Remote::take_bodies(const wire::State& state)
{
    std::int64_t most = 0; // largest impulse that its hand has newly given to one body
    for (const wire::BodyState& body : state.bodies) {
        std::size_t i = 0;
        while (i < count_ && bodies_[i].body != body.body) ++i;
        if (i == count_) {
            if (count_ == bodies_.size()) continue; // no honest peer sends more bodies
            bodies_[count_] = {};
            bodies_[count_++].body = body.body;
        }
        if (count_ > 1 && state.touching) {
            std::int64_t given = 0;
            for (const std::int64_t part :
                 wire::difference(body.caused_impulse_uns, bodies_[i].caused_impulse_uns))
                given += std::abs(part);
            if (given > most) {
                most = given;
                touched_ = i;
            }
        }
        bodies_[i] = body;
    }
}

const wire::BodyState* Remote::body(std::uint16_t id) const
{
    const auto* const end = bodies_.begin() + count_;
    const auto* const found =
        std::find_if(bodies_.begin(), end, [id](const auto& body) { return body.body == id; });
    return found == end ? nullptr : found;
}

const wire::BodyState* Remote::touched() const
{
    return state_ && state_->touching && touched_ < count_ ? &bodies_[touched_] : nullptr;
}

void Remote::forget_state()
{
    state_.reset();
    count_ = 0;
    touched_ = 0;
    arrived_.reset();
}

double Remote::freshness_at(base::TimePoint now) const
{
    if (gone_ || !arrived_) return 0.0;
    const base::Duration past_hold = (now - *arrived_) - staleness_.hold;
    if (past_hold <= base::Duration{0}) return 1.0;
    if (past_hold >= staleness_.fade) return 0.0;
    return 1.0 - base::to_seconds(past_hold) / base::to_seconds(staleness_.fade);
}

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/lag.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::peer {

void Lag::hear(const ReceivedState& received)
{
    RemoteHand& hand = hands_[received.from];
    const auto tick = hand.heard.hear(received);
    if (!tick) return;
    // An overtaken message is as useful as any other, because it describes another tick.
    if (!hand.heard.history.add(*tick, HandSample::of(received.state))) return;
    if (!received.taken) return;
    if (const auto answered = answered_tick(received)) hand.ages_there.add(*tick - *answered);
}

void Lag::forget(std::size_t of)
{
    hands_[of].heard.forget();
    hands_[of].ages.forget();
    hands_[of].ages_there.forget();
}

void Lag::note_ages(const Situation& situation, std::int64_t now)
{
    for (std::size_t i = 0; i < hands_.size(); ++i) {
        RemoteHand& hand = hands_[i];
        if (situation.others[i].freshness() > 0.0 && !hand.heard.history.is_empty())
            hand.ages.add(now - hand.heard.history.newest());
        hand.ages.pass(situation.tick, options_.memory);
        hand.ages_there.pass(situation.tick, options_.memory);
    }
}

/// Updates the lag. It increases at once, and decreases as slowly as time may run faster.
void Lag::follow(const Situation& situation)
{
    constexpr std::int64_t looks_every = 10; // ticks
    if (has_begun_ && situation.number % looks_every != 0) return;
    std::int64_t wanted = 0;
    for (const RemoteHand& hand : hands_) {
        wanted = std::max(wanted, hand.ages.value(options_.quantile));
        wanted = std::max(wanted, hand.ages_there.value(options_.quantile));
    }
    constexpr double most = HandHistory::ticks_max - 24;
    const double lag_max =
        std::min(most, base::to_seconds(options_.lag_max) / base::to_seconds(situation.tick));
    const double goal = std::min(lag_max, static_cast<double>(wanted));
    lag_ = std::max(goal, lag_ - options_.catch_up * looks_every);
}

/// True if all peers are heard whose hands may appear in the first ticks.
bool Lag::is_ready(const Situation& situation) const
{
    if (has_begun_ || situation.now - situation.start > waits_for) return true;
    return std::ranges::none_of(
        hands_, [](const RemoteHand& hand) { return hand.heard.history.is_empty(); });
}

/// Plays one tick of the session.
void Lag::play(scene::World& world, const Situation& situation)
{
    ++played_;
    world.set_hand(own_hand_by_rank(situation), own_.at(played_, situation.tick).input());
    for (std::size_t i = 0; i < hands_.size(); ++i) {
        const bool is_there = situation.others[i].freshness() > 0.0;
        const HandSample sample = hands_[i].heard.history.at(played_, situation.tick);
        world.set_hand(hand_by_rank(i, situation),
                       is_there ? sample.input() : scene::HandInput{.present = false});
    }
    world.tick();
    if (rest_.play(played_, world, situation.body)) way_ticks_ = 0;
    if (way_ticks_ > 0) {
        world.shift(situation.body, way_a_tick_);
        --way_ticks_;
    }
}

/// Makes copies agree that differ because messages were lost. The copy that yields moves to the
/// place of the other at rest, in as many ticks as base takes.
void Lag::rest(const Situation& situation)
{
    const auto leader = yields_to(situation);
    if (!leader || !hands_[*leader].heard.told) return;
    RestAgreement::Word word = *hands_[*leader].heard.told;
    // In a pair, both peers know the same ages, and so have about the same lag.
    constexpr std::int64_t about = 10; // ticks
    const bool is_pair = hands_.size() == 1;
    word.knows = word.tick - (is_pair ? lag_ticks() + about : HandHistory::ticks_max);
    rest_.hear(word);
    const auto ticks = BaseOptions{}.settle_within / situation.tick;
    const auto way = rest_.take_way(ticks);
    if (!way) return;
    way_a_tick_ = (1.0 / static_cast<double>(ticks)) * *way;
    way_ticks_ = ticks;
}

Outcome Lag::tick(scene::World& world, const Situation& situation)
{
    const std::int64_t now =
        ticks_.number(situation.number, situation.now - situation.start, situation.tick);
    own_.add(now, HandSample::of(world.state().hands[own_hand]));
    note_ages(situation, now);
    follow(situation);
    const std::int64_t due = now - lag_ticks();
    if (!first_) first_ = now;
    if (!has_begun_ && is_ready(situation)) {
        has_begun_ = true;
        const bool joins_late = *first_ > 0; // its copy begins with the body as it is now
        played_ = joins_late ? due - 1 : -1;
    }
    if (has_begun_) {
        played_ = std::max(played_, now - HandHistory::ticks_max + 1);
        for (int i = 0; i < together_max && played_ < due; ++i) play(world, situation);
    }
    return outcome_of(world, situation, now);
}

Outcome Lag::outcome_of(scene::World& world, const Situation& situation, std::int64_t now)
{
    Outcome outcome;
    if (has_begun_) outcome.touched = world.touch(own_hand_by_rank(situation));
    outcome.on_hand = outcome.touched.on_hand;
    outcome.late = has_begun_ ? (now - played_) * situation.tick : base::Duration{0};
    says_grip(outcome.touched, own_.at(now, situation.tick));
    for (std::size_t i = 0; i < hands_.size(); ++i) {
        const scene::HandTouch& touch = world.touch(hand_by_rank(i, situation));
        outcome.remote_touching = outcome.remote_touching || touch.touching;
        outcome.remote_force += touch.on_body;
    }
    if (const auto& state = situation.remote.state()) outcome.remote_hip = state->hip;
    rest(situation);
    return outcome;
}

} // namespace hapnet::peer

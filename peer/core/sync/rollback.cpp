// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/rollback.hpp"

#include <algorithm>

namespace hapnet::peer {

void Rollback::prepare(std::size_t others, const scene::World& world)
{
    const ProxyHandOptions learning{.hand = options_.hand,
                                    .velocity_filter = options_.velocity_filter,
                                    .velocity_filter_min = options_.velocity_filter_min,
                                    .believed_above_m_per_s = options_.believed_above_m_per_s,
                                    .memory = options_.memory};
    hands_.assign(others, RemoteHand{learning});
    past_ = world;
    present_ = world;
}

void Rollback::hear(const ReceivedState& received)
{
    RemoteHand& hand = hands_[received.from];
    const auto tick = hand.heard.hear(received);
    if (!tick) return;
    // An overtaken message fills a gap, unless the past already includes its tick.
    if (*tick > confirmed_ && hand.heard.history.add(*tick, HandSample::of(received.state)))
        has_news_ = true;
    if (!received.taken) return;
    static_cast<void>(hand.learnt.hear(received));
    hand.touches = received.state.touching;
}

void Rollback::forget(std::size_t of)
{
    hands_[of].heard.forget();
    hands_[of].learnt.forget();
    hands_[of].touches = false;
    hands_[of].whole = confirmed_;
}

/// Begins with the present state of `world`, at the start and after it was changed from outside.
void Rollback::begin(const scene::World& world, std::int64_t now)
{
    past_->restore(world);
    present_->restore(world);
    confirmed_ = now - 1;
    for (RemoteHand& hand : hands_) hand.whole = confirmed_;
    offset_ = offset_speed_ = glm::dvec3{0.0};
}

bool Rollback::is_modelled(const RemoteHand& hand, std::int64_t tick)
{
    return !hand.heard.history.is_empty() && tick > hand.heard.history.newest();
}

void Rollback::set_past_hands(scene::World& world, const Situation& situation,
                              std::int64_t tick) const
{
    world.set_hand(own_hand_by_rank(situation), own_.at(tick, situation.tick).input());
    for (std::size_t i = 0; i < hands_.size(); ++i) {
        const HandHistory& history = hands_[i].heard.history;
        HandSample sample = history.at(tick, situation.tick);
        // A hand that has fallen silent counts as absent once the past has waited long enough for
        // it.
        if (tick > history.newest()) sample.present = false;
        world.set_hand(hand_by_rank(i, situation), sample.input());
    }
}

void Rollback::set_present_hands(scene::World& world, const Situation& situation, std::int64_t tick)
{
    set_past_hands(world, situation, tick);
    for (std::size_t i = 0; i < hands_.size(); ++i) {
        RemoteHand& hand = hands_[i];
        if (!is_modelled(hand, tick)) continue;
        const HandSample last = hand.heard.history.at(hand.heard.history.newest(), {});
        if (tick == hand.heard.history.newest() + 1) hand.motion = {last.place, last.velocity};
        const bool is_there = last.present && hand.touches && situation.others[i].freshness() > 0.0;
        const scene::HandInput input{.position = {hand.motion.place},
                                     .velocity = {hand.motion.speed},
                                     .present = is_there,
                                     .gripping = last.gripping};
        world.set_hand(hand_by_rank(i, situation), input);
    }
}

/// Moves the modelled hands after a tick of the present, against the forces that they have met in
/// it.
void Rollback::move_models(const scene::World& world, const Situation& situation, std::int64_t tick)
{
    const double tick_s = base::to_seconds(situation.tick);
    const double ahead_max_s = base::to_seconds(options_.ahead_max);
    for (std::size_t i = 0; i < hands_.size(); ++i) {
        RemoteHand& hand = hands_[i];
        if (!is_modelled(hand, tick)) continue;
        const HandDynamics& dynamics = hand.learnt.dynamics();
        const auto ticks = static_cast<double>(tick - hand.heard.history.newest());
        const double ahead_s = std::min(ticks * tick_s, ahead_max_s);
        const glm::dvec3 anchor = hand.learnt.intention() +
                                  (hand.learnt.eta() * ahead_s) * hand.learnt.intention_velocity();
        const glm::dvec3 met = world.touch(hand_by_rank(i, situation)).on_hand.value;
        for (int step = 0; step < hand_steps_per_tick; ++step) {
            const glm::dvec3 drive = dynamics.stiffness_n_per_m * (anchor - hand.motion.place);
            hand.motion.step(dynamics, dynamics.friction_n, drive + met,
                             tick_s / hand_steps_per_tick);
        }
    }
}

/// Returns the last tick for which all hands are known well enough for the past.
std::int64_t Rollback::known_until(const Situation& situation, std::int64_t now)
{
    std::int64_t until = now;
    const auto patience = static_cast<std::int64_t>(options_.patience / situation.tick);
    for (std::size_t i = 0; i < hands_.size(); ++i) {
        RemoteHand& hand = hands_[i];
        const HandHistory& history = hand.heard.history;
        const auto arrived = situation.others[i].arrived();
        const bool is_awaited = arrived ? situation.now - *arrived <= options_.silence_max
                                        : situation.now - situation.start <= waits_for;
        hand.whole = std::max(hand.whole, confirmed_);
        while (history.knows(hand.whole + 1)) ++hand.whole;
        if (!is_awaited) continue;
        until = std::min(until, std::max(hand.whole, history.newest() - patience));
    }
    return std::max(until, now - resimulated_max);
}

/// Advances the past as far as it is known. Returns true if it has advanced.
bool Rollback::confirm(const Situation& situation, std::int64_t now)
{
    const std::int64_t until = known_until(situation, now);
    const bool moves = confirmed_ < until;
    while (confirmed_ < until) {
        set_past_hands(*past_, situation, ++confirmed_);
        past_->tick();
        rest_.play(confirmed_, *past_, situation.body);
    }
    return moves;
}

void Rollback::step_present(const Situation& situation, std::int64_t tick)
{
    set_present_hands(*present_, situation, tick);
    present_->tick();
    move_models(*present_, situation, tick);
}

/// Computes the present again, starting from the past.
void Rollback::predict(const Situation& situation, std::int64_t now)
{
    present_->restore(*past_);
    for (RemoteHand& hand : hands_) {
        const HandHistory& history = hand.heard.history;
        if (history.is_empty() || history.newest() > confirmed_) continue;
        const HandSample last = history.at(history.newest(), {});
        hand.motion = {last.place, last.velocity};
    }
    for (std::int64_t tick = confirmed_ + 1; tick <= now; ++tick) step_present(situation, tick);
}

/// Finds the force that this peer's hand feels. It is that of its contact with the body as shown.
/// The other hands have the same distance from the body as in the present world.
Outcome Rollback::feel(scene::World& world, const Situation& situation, std::int64_t now)
{
    const scene::HandInput own = world.state().hands[own_hand];
    set_present_hands(world, situation, now);
    for (std::size_t i = 0; i < hands_.size(); ++i) {
        const std::uint32_t hand = hand_by_rank(i, situation);
        scene::HandInput input = world.state().hands[hand];
        input.position.value += offset_;
        world.set_hand(hand, input);
    }
    world.set_hand(own_hand_by_rank(situation), own);
    world.tick();
    Outcome outcome;
    outcome.touched = world.touch(own_hand_by_rank(situation));
    outcome.on_hand = outcome.touched.on_hand;
    for (std::size_t i = 0; i < hands_.size(); ++i) {
        const scene::HandTouch& touch = world.touch(hand_by_rank(i, situation));
        outcome.remote_touching = outcome.remote_touching || touch.touching;
        outcome.remote_force += touch.on_body;
        if (&situation.others[i] == &situation.remote)
            outcome.remote_hip = world.state().hands[hand_by_rank(i, situation)].position;
    }
    return outcome;
}

/// Moves the shown body to the present one with a critically damped spring.
void Rollback::smooth(const glm::dvec3& jump, double tick_s)
{
    offset_ += jump;
    const double smoothing_s = base::to_seconds(options_.smoothing);
    if (!(smoothing_s > tick_s)) {
        offset_ = offset_speed_ = glm::dvec3{0.0};
        return;
    }
    const glm::dvec3 pull =
        (-2.0 / smoothing_s) * offset_speed_ - (1.0 / (smoothing_s * smoothing_s)) * offset_;
    offset_speed_ += tick_s * pull;
    offset_ += tick_s * offset_speed_;
}

/// Makes pasts agree that differ because messages were lost. The copy that yields moves to the
/// place of the other at rest; the offset moves the shown body there.
base::Displacement Rollback::rest(const Situation& situation, const Outcome& outcome)
{
    const auto leader = yields_to(situation);
    if (!leader || !hands_[*leader].heard.told) return {};
    RestAgreement::Word word = *hands_[*leader].heard.told;
    // In a pair, the other peer answers this hand's messages, by the clock. With more peers, the
    // age of a message between two others is not known.
    word.knows = hands_.size() == 1 ? word.knows - SessionTicks::in_time / situation.tick
                                    : word.tick - resimulated_max;
    rest_.hear(word);
    if (outcome.touched.touching || outcome.remote_touching) return {};
    const base::Duration rest = std::max(rests_for, 2 * options_.smoothing);
    const auto way = rest_.take_way(rest / situation.tick);
    if (!way) return {};
    past_->shift(situation.body, *way);
    present_->shift(situation.body, *way);
    return *way;
}

void Rollback::show(scene::World& world, const Situation& situation)
{
    world.restore(*present_);
    world.shift(situation.body, {offset_});
    shown_ = world.position(situation.body);
}

Outcome Rollback::tick(scene::World& world, const Situation& situation)
{
    const std::int64_t now =
        ticks_.number(situation.number, situation.now - situation.start, situation.tick);
    own_.add(now, HandSample::of(world.state().hands[own_hand]));
    if (!shown_ || !(*shown_ == world.position(situation.body))) begin(world, now);

    Outcome outcome = feel(world, situation, now);
    says_grip(outcome.touched, own_.at(now, situation.tick));
    step_present(situation, now);
    glm::dvec3 jump{0.0};
    if (confirm(situation, now) || has_news_) {
        const base::Position before = present_->position(situation.body);
        predict(situation, now);
        jump = (before - present_->position(situation.body)).value;
    }
    has_news_ = false;
    jump -= rest(situation, outcome).value;
    smooth(jump, base::to_seconds(situation.tick));
    show(world, situation);
    return outcome;
}

} // namespace hapnet::peer

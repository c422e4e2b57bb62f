// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/proxy_hand.hpp"

#include "proto/base/math.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::peer {

namespace {

/// Returns the share of a step that a first-order filter passes in a time.
double share_in(double seconds, double constant_s)
{
    return constant_s > 0.0 ? 1.0 - base::exp(-seconds / constant_s) : 1.0;
}

glm::dvec3 shortened(const glm::dvec3& v, double length_max)
{
    const double length = glm::length(v);
    return length > length_max ? (length_max / length) * v : v;
}

} // namespace

void HandMotion::step(const HandDynamics& hand, double friction_n, const glm::dvec3& force,
                      double seconds)
{
    const double damping = 1.0 + hand.damping_ns_per_m * seconds / hand.mass_kg;
    for (int axis = 0; axis < 3; ++axis) {
        const double before = speed[axis];
        const double along =
            before != 0.0 ? std::copysign(1.0, before) : std::copysign(1.0, force[axis]);
        const bool sticks = before == 0.0 && std::abs(force[axis]) <= friction_n;
        const double after =
            sticks
                ? 0.0
                : (before + seconds * (force[axis] - along * friction_n) / hand.mass_kg) / damping;
        // Friction stops a motion, but never reverses it.
        speed[axis] = after * along < 0.0 ? 0.0 : after;
        place[axis] += seconds * speed[axis];
    }
}

ProxyHand::ProxyHand(const ProxyHandOptions& options)
    : options_{options}, hand_{options.hand}, words_(words_max)
{}

void ProxyHand::take_dynamics(const wire::HandModel& said)
{
    const auto take = [](double& value, float heard) {
        if (heard > 0.0F) value = static_cast<double>(heard);
    };
    hand_ = options_.hand;
    take(hand_.mass_kg, said.mass);
    take(hand_.damping_ns_per_m, said.damping);
    take(hand_.stiffness_n_per_m, said.stiffness);
    take(hand_.friction_n, said.friction);
}

base::Duration ProxyHand::age(base::TimePoint now) const
{
    return std::max(base::Duration{0}, now - sent_at_);
}

double ProxyHand::hear(const ReceivedState& received)
{
    const wire::State& state = received.state;
    const double tick_s = base::to_seconds(received.tick);
    const base::Duration delay =
        std::max(base::Duration{0}, one_way_delay(received).value_or(base::Duration{0}));
    const double age_s = base::to_seconds(delay);
    const bool is_first = !has_heard_;
    const std::uint32_t ticks = is_first ? 0 : received.tick_number - tick_number_;
    if (is_first) take_dynamics(received.hand);
    has_heard_ = true;
    tick_number_ = received.tick_number;
    sent_at_ = received.arrived - delay;
    if (state.touching) touched_at_ = sent_at_;
    contact_force_ = base::limited(state.contact_force, received.force_max_n).value;
    intention_ = (state.hip + state.intention).value;
    const double filter_s =
        std::max(base::to_seconds(options_.velocity_filter_min), options_.velocity_filter * age_s);
    const double share = is_first ? 1.0 : share_in(ticks * tick_s, filter_s);
    velocity_ += share * (state.intention_velocity.value - velocity_);
    ages_.add(age_s);

    const Heard word{received.tick_number, intention_, velocity_};
    if (!is_first) learn(word, ticks, tick_s, age_s);
    words_[heard_++ % words_max] = word;

    const std::uint32_t work_before_uj = is_first ? state.work_uj : work_uj_;
    work_uj_ = state.work_uj;
    return 1e-6 * static_cast<double>(static_cast<std::int32_t>(work_uj_ - work_before_uj));
}

/// Returns the newest message with at most this tick number. The requested numbers must not
/// decrease.
const ProxyHand::Heard* ProxyHand::heard_at(std::uint32_t tick_number)
{
    if (heard_ == 0) return nullptr;
    if (heard_ > words_max) older_ = std::max(older_, heard_ - words_max);
    while (older_ + 1 < heard_ && words_[(older_ + 1) % words_max].tick_number <= tick_number)
        ++older_;
    const Heard& found = words_[older_ % words_max];
    return found.tick_number <= tick_number ? &found : nullptr;
}

/// Learns by least squares how well an extrapolation of an earlier message predicts this one. The
/// prior makes a slow hand stay where it was received.
void ProxyHand::learn(const Heard& word, std::uint32_t ticks, double tick_s, double age_s)
{
    const auto age_ticks = static_cast<std::uint32_t>(std::lround(age_s / tick_s));
    if (age_ticks >= word.tick_number) return;
    const Heard* const old = heard_at(word.tick_number - age_ticks);
    if (old == nullptr) return;
    const double apart_s = (word.tick_number - old->tick_number) * tick_s;
    const glm::dvec3 predicted = apart_s * old->velocity;
    const glm::dvec3 truly = word.place - old->place;
    const double share = share_in(ticks * tick_s, base::to_seconds(options_.memory));
    predicted_true_ += share * (glm::dot(predicted, truly) - predicted_true_);
    predicted_ += share * (glm::dot(predicted, predicted) - predicted_);
    true_ += share * (glm::dot(truly, truly) - true_);
    const double slow_m = options_.believed_above_m_per_s * age_s;
    const double scale = predicted_ + slow_m * slow_m;
    eta_ = scale > 0.0 ? std::clamp(predicted_true_ / scale, 0.0, 1.0) : 0.0;
}

void ProxyHand::forget()
{
    has_heard_ = false;
    is_there_ = false;
    touched_at_.reset();
    heard_ = 0;
    older_ = 0;
    predicted_true_ = predicted_ = true_ = 0.0;
    eta_ = 0.0;
    trust_ = 1.0;
}

/// Puts the proxy where the hand is relative to the other peer's copy of the body, turned by the
/// difference between both orientations. The proxy moves with this peer's copy of the body.
void ProxyHand::enter(const View& view)
{
    is_there_ = true;
    trust_ = 1.0;
    const scene::BodyState body = view.world.body(view.there->body);
    const base::Position hip = view.other.state()->hip;
    glm::dvec3 lever = (hip - view.there->position).value;
    glm::dvec3 pull = intention_ - hip.value;
    motion_.speed = body.velocity.value;
    if (view.there->turning) {
        const glm::dquat turn =
            body.orientation * glm::conjugate(view.there->turning->orientation.quaternion());
        lever = turn * lever;
        pull = turn * pull;
        motion_.speed += glm::cross(body.angular_velocity, lever);
    }
    motion_.place = body.position.value + lever;
    anchor_ = motion_.place + pull;
}

void ProxyHand::look(const View& view)
{
    const double tick_s = base::to_seconds(view.tick);
    const double age_s = base::to_seconds(age(view.now));
    ages_.fade(tick_s);
    ages_.add(age_s);
    const auto& state = view.other.state();
    const bool acts = has_heard_ && state && view.there && (state->touching || state->holding) &&
                      view.other.freshness() > 0.0;
    if (!acts) {
        is_there_ = false;
        return;
    }
    gripping_ = state->holding;
    if (!is_there_) enter(view);
    const double ahead_max_s = base::to_seconds(options_.ahead_max);
    const glm::dvec3 wanted = intention_ + (eta_ * std::min(age_s, ahead_max_s)) * velocity_;
    glm::dvec3 way = age_s < ahead_max_s ? (eta_ * tick_s) * velocity_ : glm::dvec3{0.0};
    way += share_in(tick_s, base::to_seconds(options_.anchor_filter)) * (wanted - anchor_ - way);
    anchor_ += shortened(way, options_.anchor_speed_m_per_s * tick_s);

    double trusted = 1.0;
    if (view.own_hand_touches) {
        const double missed = true_ - 2.0 * eta_ * predicted_true_ + eta_ * eta_ * predicted_;
        trusted = 1.0 / (1.0 + missed / (options_.unsure_by_m * options_.unsure_by_m) +
                         predicted_ / (options_.soft_by_m * options_.soft_by_m));
    }
    trust_ += std::min(1.0, tick_s / trust_filter_s) * (trusted - trust_);
}

scene::HandInput ProxyHand::input() const
{
    if (!is_there_) return {.present = false};
    return {.position = {motion_.place}, .velocity = {motion_.speed}, .gripping = gripping_};
}

double ProxyHand::kinetic_energy_j() const
{
    return is_there_ ? 0.5 * hand_.mass_kg * glm::dot(motion_.speed, motion_.speed) : 0.0;
}

double ProxyHand::drive_energy_j() const
{
    if (!is_there_) return 0.0;
    const glm::dvec3 stretch = anchor_ - motion_.place;
    const double k = hand_.stiffness_n_per_m;
    return 0.5 * (trust_ * k * glm::dot(stretch, stretch) +
                  (1.0 - trust_) * glm::dot(contact_force_, contact_force_) / k);
}

double ProxyHand::step(base::Force on_hand, double share, base::Duration tick)
{
    if (!is_there_) return 0.0;
    const double seconds = base::to_seconds(tick) / hand_steps_per_tick;
    const glm::dvec3 before = motion_.place;
    const glm::dvec3 steady =
        (1.0 - trust_) * (contact_force_ + (eta_ * hand_.damping_ns_per_m) * velocity_);
    for (int part = 0; part < hand_steps_per_tick; ++part) {
        const glm::dvec3 spring = (trust_ * hand_.stiffness_n_per_m) * (anchor_ - motion_.place);
        motion_.step(hand_, trust_ * hand_.friction_n, share * (spring + steady) + on_hand.value,
                     seconds);
    }
    return glm::dot(on_hand.value, motion_.place - before);
}

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/peer.hpp"

#include "peer/core/passivity.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace hapnet::peer {

namespace {

// No hand of ours is ever farther out or faster: a sample that says so is not used.
constexpr double reach_max_m = 10.0;
constexpr double speed_max_m_per_s = 1000.0;

// Of the other side: so many times the distance of the scene's farthest body from the origin, and
// through all of that in so much time.
constexpr double reach_of_scene = 8.0;
constexpr double reach_least_m = 1.0;
constexpr double crossing_s = 0.1;

double remote_reach_m(const scene::Description& scene)
{
    double farthest_m = 0.0;
    for (const scene::BodyDescription& body : scene.bodies) {
        for (const int axis : {0, 1, 2}) {
            farthest_m =
                std::max(farthest_m, std::abs(body.position.value[axis]) + body.half[axis]);
        }
    }
    return std::clamp(reach_of_scene * farthest_m, reach_least_m, reach_max_m);
}

bool is_usable(const Hand& hand)
{
    return hand.present && scene::is_within(hand.hip.value, reach_max_m) &&
           scene::is_within(hand.velocity.value, speed_max_m_per_s);
}

scene::BodyId shared_body_of(const Settings& settings)
{
    const auto body = shared_body(settings.scene);
    base::ensure(body.has_value());
    return *body;
}

scene::World world_of(const Settings& settings)
{
    auto world = scene::World::freeze(settings.scene, {.tick = settings.tick});
    base::ensure(world.has_value());
    return *std::move(world);
}

std::optional<FingerFriction> friction_of(const Settings& settings)
{
    if (settings.scene.hands.friction == 0.0) return std::nullopt;
    return FingerFriction{settings.scene.hands};
}

/// The share of the force on the hand that may be rendered.
double rendered_share(const Settings& settings)
{
    const scene::HandDescription& hips = settings.scene.hands;
    const VirtualWall wall{hips.stiffness_n_per_m, hips.damping_ns_per_m};
    return std::min(
        share_within(settings.stiffness_max_n_per_m, wall),
        passive_share(wall, base::to_seconds(settings.tick), settings.grip_damping_ns_per_m));
}

Introduction introduction_of(const Settings& settings)
{
    Introduction introduction = settings.introduction;
    introduction.length = settings.length;
    return introduction;
}

} // namespace

Peer::Peer(const Settings& settings)
    : settings_{settings},
      handshake_{introduction_of(settings)},
      remote_{settings.staleness, base_options(settings.algorithm).stale},
      body_{shared_body_of(settings)},
      world_{world_of(settings)},
      friction_{friction_of(settings)},
      force_max_n_{std::min(settings.scene.hands.force_max_n, scene::force_max_n)},
      share_{rendered_share(settings)},
      remote_reach_m_{remote_reach_m(settings.scene)},
      sequences_{settings.tick}
{}

base::Duration Peer::hands_on() const
{
    return length() - std::min(hands_off_length, length() / 2);
}

void Peer::on_datagram(std::span<const std::byte> datagram, base::TimePoint arrived)
{
    const auto message = wire::decode(datagram);
    if (message) {
        std::visit([&](const auto& m) { on_message(m, arrived); }, *message);
        return;
    }
    const auto version = wire::version_of(datagram);
    if (!version || *version == wire::protocol_version) {
        ++counters_.malformed;
        return;
    }
    ++counters_.other_version;
    if (!session()) consider_refusal({wire::ByeReason::other_version, *version}, arrived);
}

void Peer::on_message(const wire::Hello& hello, base::TimePoint arrived)
{
    ++counters_.hellos;
    const bool had_met = handshake_.has_met();
    const bool had_session = session().has_value();
    const bool is_heard = had_session && !gone_ && remote_.freshness(arrived) >= 1.0;
    const auto known = is_heard ? Handshake::Known::heard : Handshake::Known::silent;
    if (const auto reason = handshake_.on_hello(hello, arrived, known)) {
        if (had_session) {
            outbox_.put(wire::encode(wire::Bye{0, *reason})); // our session goes on without it
        } else {
            consider_refusal({*reason, hello.nonce}, arrived);
        }
        return;
    }
    pending_refusal_.reset();
    if (!had_met) events_.put(Event::met);
    if (!session() || session()->number == current_.number) return;
    // A late hello of an earlier run may make us change over and back: then count on.
    former_ = std::exchange(current_, session()->number == former_.number
                                          ? former_
                                          : Numbering{.number = session()->number});
    agreed_at_ = arrived;
    remote_.forget();
    sequences_.forget();
    last_body_ = arrived;
    states_without_body_ = 0;
    std::visit([](auto& algorithm) { algorithm.forget(); }, settings_.algorithm);
    gone_ = false;
    lost_ = false;
    body_known_ = !session()->joined_late;
    events_.put(had_session ? Event::restarted : Event::agreed);
}

void Peer::on_message(const wire::State& state, base::TimePoint arrived)
{
    if (!session() || state.session != current_.number) {
        ++counters_.other_session;
        return;
    }
    if (!is_plausible(state) || state.sequence > sequence_max(arrived) ||
        !sequences_.admits(state, arrived)) {
        ++counters_.implausible;
        return;
    }
    if (gone_ && !takes_back_goodbye(state, arrived)) {
        ++counters_.other_session;
        return;
    }
    handshake_.on_state();
    handshake_.on_echo(state.echo, state.sent, arrived);
    const bool taken = remote_.update(state, arrived);
    ++(taken ? counters_.states : counters_.outdated);
    if (taken) {
        sequences_.on_taken(state, arrived);
        look_for_body(state, arrived);
    }
    const ReceivedState received{.state = state,
                                 .arrived = arrived,
                                 .taken = taken,
                                 .clock = handshake_.clock(),
                                 .tick = settings_.tick,
                                 .force_max_n = force_max_n_};
    std::visit([&](auto& algorithm) { algorithm.hear(received); }, settings_.algorithm);
}

/// Whether the other side goes on although it has said goodbye; then the goodbye is forgotten.
bool Peer::takes_back_goodbye(const wire::State& state, base::TimePoint arrived)
{
    if (leaving_) return false;
    if (!goodbye_.last_sent) goodbye_.last_sent = state.sent;
    const bool goes_on = state.sent - *goodbye_.last_sent > goodbye_doubted_for &&
                         arrived - goodbye_.heard > goodbye_doubted_for;
    if (!goes_on) return false;
    gone_ = false;
    lost_ = true; // so that a person is told that it is back
    return true;
}

/// Tells once when something on the path lets only the shorter messages through.
void Peer::look_for_body(const wire::State& state, base::TimePoint arrived)
{
    if (!state.bodies.empty()) {
        last_body_ = arrived;
        states_without_body_ = 0;
        return;
    }
    ++states_without_body_;
    const bool is_missed = states_without_body_ >= states_without_body_max &&
                           arrived - last_body_ >= body_missed_after;
    if (!is_missed || body_missed_) return;
    body_missed_ = true;
    events_.put(Event::no_body);
}

std::uint32_t Peer::sequence_max(base::TimePoint arrived) const
{
    // One state a tick since the start; the slack is for clocks and starts that differ. A damaged
    // number that was believed would make all that follows look outdated.
    const auto ticks =
        std::max<base::Duration::rep>(0, (arrived - session()->start) / settings_.tick);
    return static_cast<std::uint32_t>(
        std::min<base::Duration::rep>(ticks + sequence_slack, UINT32_MAX));
}

bool Peer::is_plausible(const wire::State& state) const
{
    const double speed_m_per_s = remote_reach_m_ / crossing_s;
    const auto is_possible = [&](const base::Position& place, const base::Velocity& velocity) {
        return scene::is_within(place.value, remote_reach_m_) &&
               scene::is_within(velocity.value, speed_m_per_s);
    };
    if (!is_possible(state.hip, state.hip_velocity)) return false;
    return std::all_of(state.bodies.begin(), state.bodies.end(), [&](const wire::BodyState& body) {
        return body.body == body_ && is_possible(body.position, body.velocity);
    });
}

void Peer::on_message(const wire::Bye& bye, base::TimePoint arrived)
{
    ++counters_.byes;
    const bool refuses = bye.reason >= wire::ByeReason::other_version;
    if (refuses) {
        if (!session()) consider_refusal({bye.reason, 0}, arrived);
        return;
    }
    if (!session() || bye.session != current_.number || gone_) return;
    gone_ = true;
    goodbye_ = {.heard = arrived, .last_sent = {}};
    if (remote_.state()) goodbye_.last_sent = remote_.state()->sent;
    if (!leaving_) events_.put(Event::left);
}

void Peer::consider_refusal(const PendingRefusal& refusal, base::TimePoint arrived)
{
    if (refusal_) return;
    const bool again = pending_refusal_ && pending_refusal_->reason == refusal.reason &&
                       pending_refusal_->about == refusal.about;
    if (!again) {
        pending_refusal_ = refusal;
    } else if (arrived - pending_refusal_->last < refusal_every) {
        return;
    }
    pending_refusal_->last = arrived;
    if (++pending_refusal_->times < refusals_needed) return;
    refusal_ = refusal.reason;
    events_.put(Event::refused);
    leave(refusal.reason);
}

void Peer::leave(wire::ByeReason reason)
{
    if (leaving_) return;
    leaving_ = true;
    leaving_because_ = reason;
    const bool has_audience = handshake_.has_met() || refusal_;
    if (!has_audience) byes_left_ = 0;
}

Phase Peer::phase_at(base::TimePoint now) const
{
    if (leaving_) return Phase::ended;
    if (!session()) return Phase::waiting;
    const base::Duration since_start = now - session()->start;
    if (since_start < base::Duration{0}) return Phase::countdown;
    if (since_start < hands_on()) return Phase::running;
    if (since_start < length()) return Phase::hands_off;
    return Phase::ended;
}

void Peer::note(Phase phase, double freshness, base::TimePoint now)
{
    const bool in_session = phase == Phase::running || phase == Phase::hands_off;
    if (phase != phase_) {
        if (phase == Phase::running) {
            events_.put(session()->joined_late ? Event::joined : Event::started);
        }
        if (phase == Phase::hands_off) events_.put(Event::hands_off);
        if (phase == Phase::ended && !refusal_) {
            events_.put(session() ? Event::ended : Event::stopped);
        }
        phase_ = phase;
    }
    if (!in_session || gone_) return;
    const bool may_be_on_its_way = now - std::max(session()->start, agreed_at_) < first_word_within;
    if (!remote_.arrived() && may_be_on_its_way) return;
    const bool lost = freshness <= 0.0;
    if (lost != lost_) events_.put(lost ? Event::lost : Event::back);
    lost_ = lost;
}

Tick Peer::tick(base::TimePoint now, const Hand& hand)
{
    const Phase phase = phase_at(now);
    const bool in_session = phase == Phase::running || phase == Phase::hands_off;
    Tick tick;
    tick.phase = gone_ && in_session ? Phase::alone : phase;
    tick.freshness = gone_ ? 0.0 : remote_.freshness(now);
    note(phase, tick.freshness, now);
    if (phase == Phase::ended) {
        leave(wire::ByeReason::finished);
        say_bye(now);
        return tick;
    }
    if (const auto hello = handshake_.hello(now)) outbox_.put(wire::encode(*hello));
    if (in_session) play(tick, now, hand);
    return tick;
}

void Peer::play(Tick& tick, base::TimePoint now, const Hand& hand)
{
    if (!body_known_ && remote_.body()) {
        world_.place(body_, remote_.body()->position, remote_.body()->velocity);
        body_known_ = true;
    }
    const bool usable = is_usable(hand);
    if (!usable) ++counters_.unusable_hand;
    const scene::HandInput input{.position = usable ? hand.hip : base::Position{},
                                 .velocity = usable ? hand.velocity : base::Velocity{},
                                 .present = usable,
                                 .gripping = hand.gripping};
    const Situation situation{.now = now,
                              .body = body_,
                              .remote = remote_,
                              .freshness = tick.freshness,
                              .yields = !session()->is_left,
                              .tick = settings_.tick,
                              .clock = handshake_.clock(),
                              .force_max_n = force_max_n_};
    const base::Position before = position();
    if (body_known_) move_world(tick, situation, input);
    keep_within_reach();
    account(tick, position() - before, now);
    // The governor's own fade runs along with the remote's: zero when the remote counts as gone.
    tick.permitted = usable && body_known_ && tick.freshness >= 1.0 && tick.phase == Phase::running;
    if (!gone_) say_state(tick, now, usable ? hand : Hand{});
}

/// A remote side that lies can drag the body to where the other copy would not believe it to be any
/// more; then the two would never agree again.
void Peer::keep_within_reach()
{
    const base::Position place = position();
    if (scene::is_within(place.value, remote_reach_m_)) return;
    constexpr double inside = 0.99; // whatever is rounded on the wire
    const glm::dvec3 back =
        glm::clamp(place.value, -inside * remote_reach_m_, inside * remote_reach_m_);
    world_.place(body_, {back}, {});
}

void Peer::move_world(Tick& tick, const Situation& situation, const scene::HandInput& hand)
{
    world_.set_hand(own_hand, hand);
    base::Force rubbing;
    if (friction_) {
        rubbing = friction_->on_body(hand, world_.body(body_));
        world_.push(body_, rubbing);
    }
    const Outcome outcome = std::visit(
        [&](auto& algorithm) { return algorithm.tick(world_, situation); }, settings_.algorithm);
    tick.touched = outcome.touched;
    tick.remote_touching = outcome.remote_touching;
    tick.remote_force = outcome.remote_force;
    tick.remote_hip = outcome.remote_hip;
    base::Force on_hand = outcome.on_hand;
    if (friction_) {
        friction_->on_touch(tick.touched);
        tick.touched.on_body += rubbing;
        tick.touched.on_hand += -rubbing;
        on_hand += -rubbing;
    }
    tick.force = share_ * on_hand;
}

void Peer::account(const Tick& tick, base::Displacement moved, base::TimePoint now)
{
    const bool touching = tick.touched.touching;
    if (touching) {
        last_touch_ = now;
        effects_.add(tick.touched.on_body * settings_.tick);
    } else if (tick.remote_touching) {
        last_touch_.reset(); // the other hand has taken the body over
    }
    // The body still coasts from this hand's push for a while after it.
    const bool ours = last_touch_ && now - *last_touch_ < push_lasts;
    if (ours) effects_.add(moved);
    if (touching || base::norm(moved) > 1e-9) last_stir_ = now;
}

bool Peer::mentions_body(base::TimePoint now) const
{
    if (!body_known_) return false;
    const bool stirs = last_stir_ && now - *last_stir_ < body_lingers;
    return stirs || current_.sequence % body_every == 1;
}

void Peer::say_state(Tick& tick, base::TimePoint now, const Hand& hand)
{
    tick.sequence = ++current_.sequence;
    wire::State state;
    state.session = current_.number;
    state.sequence = current_.sequence;
    state.sent = now;
    state.echo = handshake_.echo(now);
    state.touching = tick.touched.touching;
    state.holding = tick.touched.holding;
    state.hip = hand.hip;
    state.hip_velocity = hand.velocity;
    state.work_uj = static_cast<std::uint32_t>(std::llround(1e6 * hand.work_j));
    state.intention_velocity = hand.velocity; // no algorithm asks for more than the HIP yet
    state.contact_force = tick.touched.on_body;
    if (mentions_body(now)) {
        state.bodies.add({.body = static_cast<std::uint16_t>(body_),
                          .position = position(),
                          .velocity = velocity(),
                          .caused_displacement_um = effects_.displacement_um(),
                          .caused_impulse_uns = effects_.impulse_uns(),
                          .turning = {}});
    }
    outbox_.put(wire::encode(state));
    ++counters_.sent;
}

void Peer::say_bye(base::TimePoint now)
{
    if (byes_left_ == 0 || (last_bye_ && now - *last_bye_ < bye_every)) return;
    last_bye_ = now;
    --byes_left_;
    outbox_.put(wire::encode(wire::Bye{current_.number, leaving_because_}));
}

} // namespace hapnet::peer

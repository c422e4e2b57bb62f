// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/peer.hpp"

#include "peer/core/passivity.hpp"
#include "proto/base/ensure.hpp"
#include "proto/base/nearest.hpp"
#include "scene/maths/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <memory>
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
constexpr double turn_max_rad_per_s = 1000.0;

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

std::vector<SharedBody> shared_bodies_of(const Settings& settings)
{
    auto bodies = shared_bodies(settings.scene);
    base::ensure(bodies.has_value() && check_bodies_of(settings.algorithm, *bodies).has_value());
    return *std::move(bodies);
}

std::optional<SharedPoses> poses_of(const Settings& settings, const std::vector<SharedBody>& shared)
{
    if (is_one_without_turning(shared)) return std::nullopt;
    const auto* const base = std::get_if<BaseAlgorithm>(&settings.algorithm);
    const AtRest::Times times = base == nullptr ? AtRest::usual()
                                                : AtRest::Times{base->options().settle_after,
                                                                base->options().settle_within};
    return SharedPoses{shared, settings.introduction.id, times};
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
double rendered_share(const Settings& settings, base::Duration late = {})
{
    const VirtualWall wall = hardest_wall(settings.scene);
    const double tick_s = base::to_seconds(settings.tick + 2 * late); // held for half a tick more
    return std::min(share_within(settings.stiffness_max_n_per_m, wall),
                    passive_share(wall, tick_s, settings.grip_damping_ns_per_m));
}

Member::Config member_of(const Settings& settings)
{
    Member::Config config{.introduction = settings.introduction,
                          .staleness = settings.staleness,
                          .stale = stale_of(settings.algorithm),
                          .tick = settings.tick,
                          .measures_path = settings.measures_paths};
    config.introduction.length = settings.length;
    return config;
}

} // namespace

Peer::Peer(const Settings& settings)
    : settings_{settings},
      circle_{settings.roster, member_of(settings)},
      others_(settings.roster.others.size()),
      shared_{shared_bodies_of(settings)},
      body_{shared_.front().id},
      poses_{poses_of(settings, shared_)},
      world_{world_of(settings)},
      friction_{friction_of(settings)},
      intention_{dynamics_of(settings.introduction.hand)},
      force_max_n_{std::min(settings.scene.hands.force_max_n, scene::force_max_n)},
      share_{rendered_share(settings)},
      remote_reach_m_{remote_reach_m(settings.scene)},
      effects_(shared_.size())
{
    base::ensure(circle_.is_pair() || plays_with_many(settings.algorithm));
    prepare(settings_.algorithm, others_.size(), world_);
}

void Peer::tell(Event event, const Member* about)
{
    notices_.put({event, about != nullptr ? about->id() : std::uint16_t{0}});
}

bool Peer::is_alone() const { return std::ranges::all_of(others(), &Member::is_gone); }

base::Duration Peer::hands_on() const
{
    return length() - std::min(hands_off_length, length() / 2);
}

void Peer::on_datagram(std::span<const std::byte> datagram, base::TimePoint arrived,
                       std::size_t from)
{
    const auto message = wire::decode(datagram);
    if (message) {
        std::visit([&](const auto& m) { on_message(m, arrived, from); }, *message);
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

void Peer::on_message(const wire::Hello& hello, base::TimePoint arrived, std::size_t from)
{
    Member& other = circle_.members()[from];
    if (!other.is_expected(hello.peer_id) && hello.peer_id != settings_.introduction.id) {
        ++counters_.other_session;
        return;
    }
    ++counters_.hellos;
    const bool had_session = session().has_value();
    const Member::Greeting greeting = other.on_hello(hello, arrived);
    if (greeting.refused) {
        if (greeting.had_session) {
            other.post(wire::Bye{0, *greeting.refused}); // ours goes on without it
        } else {
            consider_refusal({*greeting.refused, hello.nonce}, arrived);
        }
        return;
    }
    pending_refusal_.reset();
    if (greeting.met) tell(Event::met, &other);
    circle_.after_hello(from, arrived);
    if (greeting.in_session) forget(from);
    if (session() && !had_session) {
        body_known_ = !session()->joined_late;
        tell(Event::agreed);
    } else if (greeting.in_session && greeting.had_session) {
        // Nobody else would tell where the body is.
        if (circle_.is_pair()) body_known_ = !session()->joined_late;
        tell(Event::restarted, &other);
    }
}

/// The run of one of the others has ended.
void Peer::forget(std::size_t other)
{
    const auto forget = [&](auto& algorithm) {
        if constexpr (requires { algorithm.forget(other); }) {
            algorithm.forget(other);
        } else {
            algorithm.forget();
        }
    };
    std::visit(forget, settings_.algorithm);
}

void Peer::on_message(const wire::State& state, base::TimePoint arrived, std::size_t from)
{
    Member& other = circle_.members()[from];
    if (!other.session() || state.session != other.numbering().number) {
        ++counters_.other_session;
        other.on_state_of_another(arrived);
        return;
    }
    if (!is_plausible(state) || !other.can_be_numbered(state, arrived)) {
        ++counters_.implausible;
        return;
    }
    if (other.is_gone() && (leaving_ || !other.takes_back_goodbye(state, arrived))) {
        ++counters_.other_session;
        return;
    }
    const Member::Heard heard = other.on_state(state, arrived);
    ++(heard.taken ? counters_.states : counters_.outdated);
    if (heard.body_missed) tell(Event::no_body, &other);
    if (heard.clock_jumped) tell(Event::clock_jumped, &other);
    const ReceivedState received{.state = state,
                                 .arrived = arrived,
                                 .taken = heard.taken,
                                 .clock = RemoteClock{other.handshake().clock_sync()},
                                 .tick = settings_.tick,
                                 .force_max_n = force_max_n_,
                                 .from = from,
                                 .hand = other.handshake().hand(),
                                 .start = other.session()->start};
    std::visit([&](auto& algorithm) { algorithm.hear(received); }, settings_.algorithm);
}

inline bool Peer::is_shared(const wire::BodyState& body) const
{
    if (!poses_) return body.body == body_ && !body.turning;
    return std::ranges::any_of(shared_, [&](const SharedBody& shared) {
        return shared.id == body.body && shared.turns() == body.turning.has_value();
    });
}

inline bool Peer::is_plausible(const wire::State& state) const
{
    const double speed_m_per_s = remote_reach_m_ / crossing_s;
    const auto is_possible = [&](const base::Position& place, const base::Velocity& velocity) {
        return scene::is_within(place.value, remote_reach_m_) &&
               scene::is_within(velocity.value, speed_m_per_s);
    };
    if (!is_possible(state.hip, state.hip_velocity)) return false;
    for (const wire::BodyState& body : state.bodies) {
        if (!is_shared(body) || !is_possible(body.position, body.velocity)) return false;
        if (body.turning && !scene::is_within(body.turning->angular_velocity, turn_max_rad_per_s))
            return false;
    }
    return true;
}

void Peer::on_message(const wire::Bye& bye, base::TimePoint arrived, std::size_t from)
{
    ++counters_.byes;
    const bool refuses = bye.reason >= wire::ByeReason::other_version;
    if (refuses) {
        if (!session()) consider_refusal({bye.reason, 0}, arrived);
        return;
    }
    Member& other = circle_.members()[from];
    if (other.on_goodbye(bye, arrived) && !leaving_) tell(Event::left, &other);
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
    tell(Event::refused);
    leave(refusal.reason);
}

void Peer::leave(wire::ByeReason reason)
{
    if (leaving_) return;
    leaving_ = true;
    leaving_because_ = reason;
    const bool has_audience = refusal_ || std::ranges::any_of(others(), [](const Member& other) {
                                  return other.handshake().has_met();
                              });
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

void Peer::note(Phase phase, base::TimePoint now)
{
    const bool in_session = phase == Phase::running || phase == Phase::hands_off;
    if (phase != phase_) {
        if (phase == Phase::running) tell(session()->joined_late ? Event::joined : Event::started);
        if (phase == Phase::hands_off) tell(Event::hands_off);
        if (phase == Phase::ended && !refusal_) tell(session() ? Event::ended : Event::stopped);
        phase_ = phase;
    }
    if (!in_session) return;
    for (std::size_t i = 0; i < others_.size(); ++i) {
        Member& other = circle_.members()[i];
        const Member::Change change = other.look(now, others_[i].freshness);
        if (change != Member::Change::none)
            tell(change == Member::Change::lost ? Event::lost : Event::back, &other);
    }
}

const Tick& Peer::tick(base::TimePoint now, const Hand& hand)
{
    const Phase phase = phase_at(now);
    const bool in_session = phase == Phase::running || phase == Phase::hands_off;
    Tick& tick = *std::construct_at(&tick_); // anew, in its place
    tick.phase = in_session && is_alone() ? Phase::alone : phase;
    for (std::size_t i = 0; i < others_.size(); ++i) {
        const Member& other = others()[i];
        others_[i] = {&other.remote(), other.freshness(now), other.id()};
        tick.freshness = std::max(tick.freshness, others_[i].freshness);
    }
    note(phase, now);
    if (phase == Phase::ended) {
        leave(wire::ByeReason::finished);
        say_bye(now);
        return tick;
    }
    circle_.say_hello(now);
    if (in_session) play(tick, now, hand);
    return tick;
}

/// The one with the lowest id of those that are heard; where none is, of those that were.
std::size_t Peer::chief() const
{
    if (circle_.is_pair()) return 0;
    const auto is_heard = [](const Other& other) { return other.freshness > 0.0; };
    const auto was_heard = [](const Other& other) { return other.remote->body() != nullptr; };
    auto found = std::ranges::find_if(others_, is_heard);
    if (found == others_.end()) found = std::ranges::find_if(others_, was_heard);
    return found == others_.end() ? 0 : static_cast<std::size_t>(found - others_.begin());
}

/// One who joins late starts with the bodies where one of the others has them.
void Peer::take_bodies_over()
{
    if (body_known_) return;
    for (const Other& other : others_) {
        if (other.remote->bodies_known() < shared_.size()) continue;
        if (poses_) {
            poses_->take_over(world_, *other.remote);
        } else {
            const wire::BodyState& body = *other.remote->body();
            world_.place(body_, body.position, body.velocity);
        }
        body_known_ = true;
        return;
    }
}

/// Whether what the others do is known well enough for a hand to feel it: one of them is fresh, and
/// so are all whose hands may be on the body.
bool Peer::are_others_fresh(base::TimePoint now) const
{
    if (circle_.is_pair()) return others_.front().freshness >= 1.0;
    bool any = false;
    for (std::size_t i = 0; i < others_.size(); ++i) {
        const Member& other = others()[i];
        if (others_[i].freshness >= 1.0) {
            any = true;
        } else if (!other.counts_as_gone(gone_after, now)) {
            const auto& state = other.remote().state();
            if (state && state->touching) return false;
        }
    }
    return any;
}

void Peer::play(Tick& tick, base::TimePoint now, const Hand& hand)
{
    take_bodies_over();
    const bool usable = is_usable(hand);
    if (!usable) ++counters_.unusable_hand;
    const scene::HandInput input{.position = usable ? hand.hip : base::Position{},
                                 .velocity = usable ? hand.velocity : base::Velocity{},
                                 .present = usable,
                                 .gripping = hand.gripping};
    const std::size_t lowest = chief();
    const Situation situation{.now = now,
                              .body = body_,
                              .others = others_,
                              .remote = others()[lowest].remote(),
                              .freshness = others_[lowest].freshness,
                              .yields = others()[lowest].id() < settings_.introduction.id,
                              .tick = settings_.tick,
                              .clock = RemoteClock{others()[lowest].handshake().clock_sync()},
                              .force_max_n = force_max_n_,
                              .lower_ids = circle_.rank(),
                              .hands = &settings_.scene.hands,
                              .start = session()->start,
                              .number = ticks_played_++,
                              .poses = poses_ ? &*poses_ : nullptr};
    note_places();
    if (body_known_) move_world(tick, situation, input);
    keep_within_reach();
    account(tick, now);
    // The governor's own fade runs along with the others': zero when one of them counts as lost.
    tick.permitted = usable && body_known_ && are_others_fresh(now) && tick.phase == Phase::running;
    if (usable) {
        intention_.add({hand.hip, hand.velocity, hand.felt}, now);
    } else {
        intention_.reset();
    }
    static constexpr Hand none{};
    say_states(tick, now, usable ? hand : none);
}

/// A remote side that lies can drag the body to where the other copy would not believe it to be any
/// more; then the two would never agree again.
inline void Peer::keep_within_reach()
{
    for (const SharedBody& shared : shared_) {
        const base::Position place = world_.position(shared.id);
        if (scene::is_within(place.value, remote_reach_m_)) continue;
        constexpr double inside = 0.99; // whatever is rounded on the wire
        const glm::dvec3 back =
            glm::clamp(place.value, -inside * remote_reach_m_, inside * remote_reach_m_);
        world_.place(shared.id, {back}, {});
    }
}

inline void Peer::note_places()
{
    for (std::size_t i = 0; i < shared_.size(); ++i) {
        effects_[i].place_before = world_.position(shared_[i].id);
        if (shared_[i].turns())
            effects_[i].orientation_before = world_.body(shared_[i].id).orientation;
    }
}

void Peer::move_world(Tick& tick, const Situation& situation, const scene::HandInput& hand)
{
    world_.set_hand(own_hand, hand);
    base::Force rubbing;
    if (friction_) {
        rubbing = friction_->on_body(hand, world_.body(body_));
        world_.push(body_, rubbing);
    }
    const Outcome outcome =
        std::visit([&](auto& one) { return one.tick(world_, situation); }, settings_.algorithm);
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
    const bool is_late = outcome.late > base::Duration{0};
    tick.force = (is_late ? rendered_share(settings_, outcome.late) : share_) * on_hand;
}

void Peer::account(const Tick& tick, base::TimePoint now)
{
    using Mover = SharedPoses::Mover;
    if (poses_) {
        for (std::size_t i = 0; i < shared_.size(); ++i)
            account_for(i, poses_->mover(i), tick, now);
        return;
    }
    const Mover of_others = tick.remote_touching ? Mover::others : Mover::none;
    account_for(0, tick.touched.touching ? Mover::own : of_others, tick, now);
}

inline void Peer::account_for(std::size_t body, SharedPoses::Mover mover, const Tick& tick,
                              base::TimePoint now)
{
    Effect& effect = effects_[body];
    const SharedBody& shared = shared_[body];
    if (mover == SharedPoses::Mover::own) {
        effect.last_touch = now;
        if (tick.touched.body == shared.id) add_push(body, tick.touched);
    } else if (mover == SharedPoses::Mover::others) {
        effect.last_touch.reset(); // another hand has taken the body over
    }
    // The body still coasts from this hand's push for a while after it.
    const bool ours = effect.last_touch && now - *effect.last_touch < push_lasts;
    const base::Displacement moved = world_.position(shared.id) - effect.place_before;
    if (ours) effect.sums.add(moved);
    bool stirs = mover == SharedPoses::Mover::own || base::norm(moved) > 1e-9;
    if (shared.turns()) {
        const glm::dvec3 turned =
            scene::turn_between(effect.orientation_before, world_.body(shared.id).orientation);
        if (ours) effect.sums.add_rotation(turned);
        stirs = stirs || base::norm(base::Displacement{turned}) > 1e-7;
    }
    if (stirs) effect.last_stir = now;
}

/// Of this hand on a body, in the tick.
void Peer::add_push(std::size_t body, const scene::HandTouch& touch)
{
    Effect& effect = effects_[body];
    const base::Impulse given = touch.on_body * settings_.tick;
    effect.sums.add(given);
    if (!shared_[body].turns()) return;
    const base::Displacement lever = world_.state().hands[own_hand].position - effect.place_before;
    effect.sums.add_angular(glm::cross(lever.value, given.value));
}

/// Whether the others must hear of the body: it moves, or did a moment ago.
inline bool Peer::body_stirs(std::size_t body, base::TimePoint now) const
{
    const auto& last = effects_[body].last_stir;
    return last && now - *last < body_lingers;
}

inline wire::BodyState Peer::body_state(std::size_t body) const
{
    const SharedBody& shared = shared_[body];
    const EffectSums& sums = effects_[body].sums;
    wire::BodyState state{.body = static_cast<std::uint16_t>(shared.id),
                          .position = world_.position(shared.id),
                          .velocity = world_.velocity(shared.id),
                          .caused_displacement_um = sums.displacement_um(),
                          .caused_impulse_uns = sums.impulse_uns(),
                          .turning = {}};
    if (!shared.turns()) return state;
    const scene::BodyState turned = world_.body(shared.id);
    const auto spin =
        base::limited(base::Velocity{turned.angular_velocity}, 0.99 * turn_max_rad_per_s);
    state.turning = {.orientation = wire::Orientation::from(turned.orientation),
                     .angular_velocity = spin.value,
                     .caused_rotation_urad = sums.rotation_urad(),
                     .caused_angular_impulse_unms = sums.angular_impulse_unms()};
    return state;
}

/// Those that something touches or moves; all of them when that is due.
inline BodySet Peer::bodies_to_say(bool all, base::TimePoint now) const
{
    unsigned set = 0;
    for (std::size_t i = 0; body_known_ && i < shared_.size(); ++i)
        if (all || body_stirs(i, now)) set |= 1U << i;
    return static_cast<BodySet>(set);
}

/// The same to each of the others, but for what belongs to the two of them: number and clock.
void Peer::say_states(Tick& tick, base::TimePoint now, const Hand& hand)
{
    wire::State state;
    state.sent = now;
    state.touching = tick.touched.touching;
    state.holding = tick.touched.holding;
    state.work_uj = static_cast<std::uint32_t>(base::nearest(1e6 * hand.work_j));
    intention_.say(state, hand.hip, hand.velocity);
    state.contact_force = tick.touched.on_body;
    BodySet said = 0; // that the state has, which is mostly the same for all
    for (Member& other : circle_.members()) {
        if (!other.session() || other.is_gone()) continue;
        state.session = other.numbering().number;
        state.sequence = other.next_sequence();
        state.echo = other.handshake().echo(now);
        const BodySet due = bodies_to_say(other.is_body_due(), now);
        if (due != std::exchange(said, due)) {
            state.bodies.clear();
            for (std::size_t i = 0; i < shared_.size(); ++i)
                if ((due >> i & 1U) != 0) state.bodies.add([&] { return body_state(i); });
        }
        other.post(state);
        ++counters_.sent;
    }
    const Member& first = others().front();
    if (first.session() && !first.is_gone()) tick.sequence = first.numbering().sequence;
}

void Peer::say_bye(base::TimePoint now)
{
    if (byes_left_ == 0 || (last_bye_ && now - *last_bye_ < bye_every)) return;
    last_bye_ = now;
    --byes_left_;
    for (Member& other : circle_.members()) {
        if (other.handshake().has_met() || refusal_)
            other.post(wire::Bye{other.numbering().number, leaving_because_});
    }
}

} // namespace hapnet::peer

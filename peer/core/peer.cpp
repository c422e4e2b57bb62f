// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/peer.hpp"

#include "proto/base/ensure.hpp"
#include "proto/base/nearest.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

namespace hapnet::peer {

namespace {

constexpr double speed_max_m_per_s = 1000.0; // a sample of a faster hand is not used

bool is_usable(const Hand& hand)
{
    return hand.present && scene::is_within(hand.hip.value, SceneCopy::reach_max_m) &&
           scene::is_within(hand.velocity.value, speed_max_m_per_s);
}

Remote::Config config_of(const Settings& settings)
{
    Remote::Config config{.introduction = settings.introduction,
                          .staleness = settings.staleness,
                          .stale = stale_of(settings.algorithm),
                          .tick = settings.tick,
                          .measures_path = settings.measures_paths,
                          .playout = settings.playout};
    config.introduction.length = settings.length;
    return config;
}

} // namespace

Peer::Peer(const Settings& settings)
    : settings_{settings},
      others_{settings.roster, config_of(settings)},
      scene_{settings},
      intention_{dynamics_of(settings.introduction.hand)},
      gate_{settings.send}
{
    base::ensure(others_.is_pair() || plays_with_many(settings.algorithm));
    prepare(settings_.algorithm, others_.size(), scene_.world());
}

void Peer::tell(Event event, const Remote* about)
{
    notices_.put({event, about != nullptr ? about->id() : std::uint16_t{0}});
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
    if (!session()) refuse({wire::ByeReason::other_version, *version}, arrived);
}

void Peer::on_message(const wire::Hello& hello, base::TimePoint arrived, std::size_t from)
{
    Remote& other = others_[from];
    if (!other.is_expected(hello.peer_id) && hello.peer_id != settings_.introduction.id) {
        ++counters_.other_session;
        return;
    }
    ++counters_.hellos;
    const bool had_session = session().has_value();
    const Remote::Greeting greeting = other.on_hello(hello, arrived);
    if (greeting.refused) {
        if (greeting.had_session) {
            other.post(wire::Bye{0, *greeting.refused}); // this session continues without it
        } else {
            refuse({*greeting.refused, hello.nonce}, arrived);
        }
        return;
    }
    farewell_.forget_refusals();
    if (greeting.met) tell(Event::met, &other);
    others_.after_hello(from, arrived);
    if (greeting.in_session) forget(from);
    if (session() && !had_session) {
        scene_.await_bodies(session()->joined_late);
        tell(Event::agreed);
    } else if (greeting.in_session && greeting.had_session) {
        // In a pair no other peer can send the place of the body, so the wait depends on the
        // new session.
        if (others_.is_pair()) scene_.await_bodies(session()->joined_late);
        tell(Event::restarted, &other);
    }
}

/// Forgets the run of another peer, which has ended.
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
    Remote& other = others_[from];
    if (!other.session() || state.session != other.numbering().number) {
        ++counters_.other_session;
        other.on_state_of_another(arrived);
        return;
    }
    if (!scene_.is_plausible(state) || !other.can_be_numbered(state, arrived)) {
        ++counters_.implausible;
        return;
    }
    if (other.is_gone() && (farewell_.is_leaving() || !other.takes_back_goodbye(state, arrived))) {
        ++counters_.other_session;
        return;
    }
    if (other.on_arrival(state, arrived)) tell(Event::clock_jumped, &other);
    if (PlayoutBuffer* const playout = other.playout()) {
        if (!playout->put(state, arrived)) ++counters_.played_late;
    } else {
        hear(state, arrived, from);
    }
}

/// Passes the states that are due to the algorithm.
void Peer::play_out(base::TimePoint now)
{
    for (std::size_t from = 0; from < others_.size(); ++from) {
        PlayoutBuffer* const playout = others_[from].playout();
        if (playout == nullptr) return; // all of the others have a buffer, or none has
        if (!others_[from].session()) continue;
        while (const auto played = playout->next(now)) hear(played->state, played->at, from);
    }
}

void Peer::hear(const wire::State& state, base::TimePoint at, std::size_t from)
{
    Remote& other = others_[from];
    const Remote::Heard heard = other.on_state(state, at);
    ++(heard.taken ? counters_.states : counters_.outdated);
    if (heard.body_missed) tell(Event::no_body, &other);
    const TickCount::Counted counted = other.tick_of(state);
    const ReceivedState received{.state = state,
                                 .arrived = at,
                                 .tick_number = counted.number,
                                 .span = counted.span,
                                 .taken = heard.taken,
                                 .clock = RemoteClock{other.handshake().clock_sync()},
                                 .tick = settings_.tick,
                                 .force_max_n = scene_.force_max_n(),
                                 .from = from,
                                 .hand = other.handshake().hand(),
                                 .start = other.session()->start};
    std::visit([&](auto& algorithm) { algorithm.hear(received); }, settings_.algorithm);
}

void Peer::on_message(const wire::Bye& bye, base::TimePoint arrived, std::size_t from)
{
    ++counters_.byes;
    const bool refuses = bye.reason >= wire::ByeReason::other_version;
    if (refuses) {
        if (!session()) refuse({bye.reason, 0}, arrived);
        return;
    }
    Remote& other = others_[from];
    if (other.on_goodbye(bye, arrived) && !farewell_.is_leaving()) tell(Event::left, &other);
}

void Peer::refuse(const Farewell::Refusal& refusal, base::TimePoint arrived)
{
    if (!farewell_.refuse(refusal, arrived)) return;
    tell(Event::refused);
    leave(refusal.reason);
}

void Peer::leave(wire::ByeReason reason)
{
    const bool has_met = std::ranges::any_of(
        others(), [](const Remote& other) { return other.handshake().has_met(); });
    farewell_.leave(reason, has_met || refusal());
}

Phase Peer::phase_at(base::TimePoint now) const
{
    if (farewell_.is_leaving()) return Phase::ended;
    const std::optional<Session>& agreed = session();
    if (!agreed) return Phase::waiting;
    const base::Duration since_start = now - agreed->start;
    if (since_start < base::Duration{0}) return Phase::countdown;
    if (since_start < hands_on_of(agreed->length)) return Phase::running;
    if (since_start < agreed->length) return Phase::hands_off;
    return Phase::ended;
}

void Peer::enter(Phase phase)
{
    if (phase == phase_) return;
    if (phase == Phase::running) tell(session()->joined_late ? Event::joined : Event::started);
    if (phase == Phase::hands_off) tell(Event::hands_off);
    if (phase == Phase::ended && !refusal()) tell(session() ? Event::ended : Event::stopped);
    phase_ = phase;
}

const Tick& Peer::tick(base::TimePoint now, const Hand& hand)
{
    const Phase phase = phase_at(now);
    const bool in_session = phase == Phase::running || phase == Phase::hands_off;
    Tick& tick = *std::construct_at(&tick_); // reset in place
    tick.phase = in_session && is_alone() ? Phase::alone : phase;
    play_out(now);
    tick.freshness = others_.look(now);
    enter(phase);
    if (phase == Phase::ended) {
        leave(wire::ByeReason::finished);
        say_bye(now);
        return tick;
    }
    others_.say_hello(now);
    if (in_session) play(tick, now, hand);
    return tick;
}

void Peer::play(Tick& tick, base::TimePoint now, const Hand& hand)
{
    for (Remote& other : others_.all()) {
        const Remote::Change change = other.change(now);
        if (change != Remote::Change::none)
            tell(change == Remote::Change::lost ? Event::lost : Event::back, &other);
    }
    if (!scene_.is_known()) scene_.take_over(others());
    const bool usable = is_usable(hand);
    if (!usable) ++counters_.unusable_hand;
    const scene::HandInput input{.position = usable ? hand.hip : base::Position{},
                                 .velocity = usable ? hand.velocity : base::Velocity{},
                                 .present = usable,
                                 .gripping = hand.gripping};
    const Remote& leader = others_.leader();
    scene_.tick(tick, settings_.algorithm,
                {.now = now,
                 .body = scene_.body(),
                 .others = others(),
                 .remote = leader,
                 .yields = leader.id() < settings_.introduction.id,
                 .tick = settings_.tick,
                 .clock = RemoteClock{leader.handshake().clock_sync()},
                 .force_max_n = scene_.force_max_n(),
                 .lower_ids = rank(),
                 .hands = &settings_.scene.hands,
                 .start = session()->start,
                 .number = ticks_played_++,
                 .poses = scene_.poses()},
                input);
    // The governor fades the force at the same time as the forces of the others fade. It is zero
    // when one of them counts as lost.
    tick.permitted =
        usable && scene_.is_known() && others_.are_fresh(now) && tick.phase == Phase::running;
    if (usable) {
        intention_.add({hand.hip, hand.velocity, hand.felt}, now);
    } else {
        intention_.reset();
    }
    static constexpr Hand none{};
    say_states(tick, now, usable ? hand : none);
}

/// Sends the same state to each of the others, except for the numbers and the clock echo, which
/// differ for each pair.
void Peer::say_states(Tick& tick, base::TimePoint now, const Hand& hand)
{
    wire::State state;
    state.sent = now;
    state.touching = tick.touched.touching;
    state.holding = tick.touched.holding;
    state.work_uj = static_cast<std::uint32_t>(base::nearest(1e6 * hand.work_j));
    intention_.say(state, hand.hip, hand.velocity);
    state.contact_force = tick.touched.on_body;
    const SendCause cause = gate_.judge(state, ticks_played_ - 1);
    ++counters_.sending[cause];
    if (cause == SendCause::held_back) return;
    BodySet said = 0; // bodies in the state: mostly the same for all receivers
    for (Remote& other : others_.all()) {
        if (!other.session() || other.is_gone()) continue;
        state.session = other.numbering().number;
        state.sequence = other.next_sequence();
        state.echo = other.handshake().echo(now);
        const BodySet due =
            scene_.bodies_to_say(other.is_body_due(now, settings_.send.is_each_tick()), now);
        if (due != std::exchange(said, due)) scene_.say(state, due);
        other.post(state);
        ++counters_.sent;
    }
    const Remote& first = others().front();
    if (first.session() && !first.is_gone()) tick.sequence = first.numbering().sequence;
}

void Peer::say_bye(base::TimePoint now)
{
    if (!farewell_.says_bye(now)) return;
    for (Remote& other : others_.all()) {
        if (other.handshake().has_met() || refusal())
            other.post(wire::Bye{other.numbering().number, farewell_.because()});
    }
}

} // namespace hapnet::peer

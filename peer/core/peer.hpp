// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/farewell.hpp"
#include "peer/core/intention.hpp"
#include "peer/core/others.hpp"
#include "peer/core/outbox.hpp"
#include "peer/core/scene_copy.hpp"
#include "peer/core/send_policy.hpp"
#include "peer/core/settings.hpp"
#include "peer/core/tick.hpp"
#include "proto/base/value_kind.hpp"

#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::peer {

/// An event to report to a person.
enum class Event : std::uint8_t {
    met,       // a remote answers
    agreed,    // the start is known
    started,   // the session has begun
    joined,    // a running session was joined: the bodies are as the others have them
    lost,      // a remote was silent until its forces had faded to zero
    back,      // a remote that was lost is heard again
    restarted, // a remote came back as a new run
    left,      // a remote said goodbye
    refused,   // the two cannot play together: see refusal()
    hands_off,
    ended,
    stopped,      // ended before there was a session
    no_body,      // states arrive, but none contains a body
    clock_jumped, // a remote's clock jumped against this peer's
};

/// Counters of received messages, and of those that could not be used.
struct Counters {
    std::uint64_t states = 0; // states that were used
    std::uint64_t hellos = 0;
    std::uint64_t byes = 0;
    std::uint64_t outdated = 0; // states older than one already known, or duplicates
    std::uint64_t other_session = 0;
    std::uint64_t malformed = 0;
    std::uint64_t other_version = 0;
    std::uint64_t implausible = 0;   // states beyond the scene's reach, or with too high a number
    std::uint64_t unusable_hand = 0; // ticks in which the device's sample was not usable
    std::uint64_t played_late = 0;   // states that arrived after their playout time
    std::uint64_t sent = 0;
    base::ByName<SendCause, std::uint64_t> sending{}; // ticks of all sessions by cause
};

/// An event, and the id of the other peer that it is about; 0: it is about all, or the id is not
/// known.
struct Notice {
    Event event = Event::met;
    std::uint16_t about = 0;
};

/// One peer without device, socket or clock: its copy of the scene, its hand, its knowledge of the
/// others, and the session with them. The movable bodies of the scene are shared. Call
/// on_datagram() for each datagram that arrives and tick() once per millisecond. After that, call
/// poll() for each of the others and notice() until they are empty.
class Peer {
public:
    static constexpr base::Duration hands_off_length{std::chrono::seconds{3}};

    /// `settings.scene` must be accepted by shared_bodies() and World::freeze().
    explicit Peer(const Settings& settings);

    /// `from` is the index of the sender among the others, in the order of the roster.
    void on_datagram(std::span<const std::byte> datagram, base::TimePoint arrived,
                     std::size_t from = 0);
    /// Plays one tick. The result is valid until the next call.
    const Tick& tick(base::TimePoint now, const Hand& hand);
    /// Returns the result of the last tick().
    [[nodiscard]] const Tick& last() const { return tick_; }

    /// Returns the next datagram for one of the others, valid until on_datagram() or tick();
    /// nullptr if there is none.
    [[nodiscard]] const wire::Datagram* poll(std::size_t to = 0) { return others_[to].poll(); }
    /// Takes the next notice for a person; nullptr: there is none.
    [[nodiscard]] const Notice* notice() { return notices_.take(); }

    /// Ends the session: sends byes, after which finished() is true.
    void leave(wire::ByeReason reason);
    /// True if all byes have been sent. This peer will send nothing more.
    [[nodiscard]] bool finished() const { return farewell_.is_finished(); }

    [[nodiscard]] const scene::World& world() const { return scene_.world(); }
    /// Returns the shared bodies: every movable body of the scene, sorted by id.
    [[nodiscard]] std::span<const SharedBody> shared() const { return scene_.shared(); }
    /// Returns the owner of the i-th shared body, whose copy is authoritative: see
    /// SharedPoses::owner(). It is 0 if only one body is shared and it does not turn.
    [[nodiscard]] std::uint16_t owner(std::size_t body) const
    {
        const SharedPoses* const poses = scene_.poses();
        return poses != nullptr ? poses->owner(body) : std::uint16_t{0};
    }
    /// Returns the state of the first shared body in this copy of the scene.
    [[nodiscard]] scene::BodyState body() const { return world().body(scene_.body()); }
    /// Returns the position of the first shared body. velocity() returns its velocity.
    [[nodiscard]] base::Position position() const { return world().position(scene_.body()); }
    [[nodiscard]] base::Velocity velocity() const { return world().velocity(scene_.body()); }
    [[nodiscard]] const std::optional<Session>& session() const { return others_.session(); }
    [[nodiscard]] std::span<const Remote> others() const { return others_.all(); }
    [[nodiscard]] std::optional<ClockEstimate> clock(std::size_t of = 0) const
    {
        return others()[of].handshake().clock();
    }
    [[nodiscard]] const Algorithm& algorithm() const { return settings_.algorithm; }
    [[nodiscard]] const Counters& counters() const { return counters_; }
    [[nodiscard]] bool is_alone() const { return others_.are_gone(); }
    /// Returns the rank of this peer among all peers sorted by id, from 0. The 1st, 3rd, ... hand
    /// acts as A, the others as B.
    [[nodiscard]] std::size_t rank() const { return others_.rank(); }
    [[nodiscard]] bool is_left() const { return rank() % 2 == 0; }
    /// Returns this peer's share of its side: one divided by the number of peers on that side.
    [[nodiscard]] double share_of_side() const
    {
        const std::size_t all = others().size() + 1;
        return 1.0 / static_cast<double>(is_left() ? all - all / 2 : all / 2);
    }
    [[nodiscard]] std::optional<wire::ByeReason> refusal() const { return farewell_.refusal(); }
    /// Returns the time from the start until the hands let go.
    [[nodiscard]] base::Duration hands_on() const { return hands_on_of(length()); }
    /// Returns the time from the start until the hands let go in a session of this length.
    [[nodiscard]] static base::Duration hands_on_of(base::Duration length)
    {
        return length - std::min(hands_off_length, length / 2);
    }
    /// Returns the agreed length. Before the agreement, returns the length requested of this peer.
    [[nodiscard]] base::Duration length() const
    {
        return session() ? session()->length : settings_.length;
    }

private:
    void on_message(const wire::Hello& hello, base::TimePoint arrived, std::size_t from);
    void on_message(const wire::State& state, base::TimePoint arrived, std::size_t from);
    void on_message(const wire::Bye& bye, base::TimePoint arrived, std::size_t from);
    void play_out(base::TimePoint now);
    void hear(const wire::State& state, base::TimePoint at, std::size_t from);
    void forget(std::size_t other);
    void refuse(const Farewell::Refusal& refusal, base::TimePoint arrived);
    void tell(Event event, const Remote* about = nullptr);

    [[nodiscard]] Phase phase_at(base::TimePoint now) const;
    void enter(Phase phase);
    void play(Tick& tick, base::TimePoint now, const Hand& hand);
    void say_states(Tick& tick, base::TimePoint now, const Hand& hand);
    void say_bye(base::TimePoint now);

    Settings settings_;
    Others others_;
    SceneCopy scene_;
    Intention intention_; // where this peer's hand intends to be
    SendGate gate_;
    Farewell farewell_;
    Outbox<Notice, 32> notices_;
    Counters counters_;
    std::int64_t ticks_played_ = 0; // ticks played in the session
    Tick tick_;                     // result of the last tick
    Phase phase_ = Phase::waiting;
};

} // namespace hapnet::peer

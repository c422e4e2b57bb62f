// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/handshake.hpp"
#include "peer/core/outbox.hpp"
#include "peer/core/path_meter.hpp"
#include "peer/core/playout.hpp"
#include "peer/core/sequence_guard.hpp"
#include "peer/core/tick_count.hpp"
#include "proto/base/names.hpp"
#include "proto/base/time.hpp"
#include "proto/wire/message.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

namespace hapnet::peer {

/// Times for which the newest state of a remote holds and fades, from its arrival.
struct Staleness {
    base::Duration hold{std::chrono::milliseconds{250}};
    base::Duration fade{std::chrono::milliseconds{50}};
};

/// The treatment of a stale state: an older one that was overtaken on its way, or a duplicate.
enum class Stale : std::uint8_t { drop, take };
constexpr auto names_of(base::Tag<Stale> /*enum*/) { return base::names("drop", "take"); }

/// Another peer of the session, as this one knows it: the handshake with it, its newest state (or
/// the last to arrive when stale ones are taken), what was heard of its leaving, and the datagrams
/// that wait to be sent to it. Between states everything is held. Messages are numbered separately
/// between any two peers.
class Remote {
public:
    /// The time after the start without a state after which it counts as silent.
    static constexpr base::Duration first_word_within{std::chrono::seconds{1}};
    /// The slack of sequences, in ticks. A path that is slower one way than the other shifts the
    /// two starts by half the difference, which no peer can measure. The slack is as long as the
    /// delay of the slowest path that is accepted.
    static constexpr base::Duration::rep sequence_slack = 5000;
    /// At least one in this many states has the bodies, even if nothing moves.
    static constexpr std::uint32_t body_every = 64;
    /// States that were sent longer than this after a goodbye take it back: it was forged, or
    /// damaged. States that it overtook on its way do not count.
    static constexpr base::Duration goodbye_doubted_for{std::chrono::milliseconds{300}};
    /// This number of states without a body, over at least a second, means that states with bodies
    /// are lost: one in 64 has them even at rest.
    static constexpr std::uint32_t states_without_body_max = 10 * body_every;
    static constexpr base::Duration body_missed_after{std::chrono::seconds{1}};

    struct Config {
        Introduction introduction{}; // introduction of this peer
        std::uint16_t id = 0;        // id of the remote; 0: any peer that answers
        Handshake::StartSetBy start_set_by = Handshake::StartSetBy::lower_id;
        Staleness staleness{};
        Stale stale = Stale::drop;
        base::Duration tick{std::chrono::milliseconds{1}};
        bool measures_path = false;
        Playout playout = Playout::none;
    };
    explicit Remote(const Config& config);

    /// The changes that a hello has made.
    struct Greeting {
        std::optional<wire::ByeReason> refused;
        bool met = false;         // the remote was heard for the first time
        bool in_session = false;  // a session with this run of the remote has begun
        bool had_session = false; // there was a session before this hello
    };
    [[nodiscard]] Greeting on_hello(const wire::Hello& hello, base::TimePoint arrived);
    /// True if a hello with this id is from the remote that is expected here.
    [[nodiscard]] bool is_expected(std::uint16_t id) const { return id_ == 0 || id == id_; }

    /// True if the number of a state can be right. The state must be plausible in itself.
    [[nodiscard]] bool can_be_numbered(const wire::State& state, base::TimePoint arrived) const;
    /// True if the remote goes on after its goodbye. The goodbye is then forgotten.
    [[nodiscard]] bool takes_back_goodbye(const wire::State& state, base::TimePoint arrived);
    struct Heard {
        bool taken = false;       // the state counts; a stale one only with Stale::take
        bool body_missed = false; // the remote's states lack bodies; true only once
    };
    /// Learns about path and clock from a state that has arrived. True if its clock has jumped.
    bool on_arrival(const wire::State& state, base::TimePoint arrived);
    /// Takes a state that counts from `at`: its arrival, or its playout.
    [[nodiscard]] Heard on_state(const wire::State& state, base::TimePoint at);
    /// The buffer in which its states wait; nullptr: they count as they arrive.
    [[nodiscard]] PlayoutBuffer* playout() const { return playout_.get(); }
    /// The part of it that algorithms see: the newest state. False when it is stale and dropped.
    bool update(const wire::State& state, base::TimePoint arrived);
    /// The tick of the remote that a state tells of, from 1 in the session.
    [[nodiscard]] TickCount::Counted tick_of(const wire::State& state)
    {
        return tick_count_.of(state, tick_);
    }
    /// A state of another session. Where nothing is heard in this one, a late hello of a former run
    /// may have made this peer change back to that: it says hello, so that the present run does.
    void on_state_of_another(base::TimePoint arrived)
    {
        if (session() && freshness_at(arrived) <= 0.0) handshake_.ask();
    }
    /// True the first time in a session.
    [[nodiscard]] bool on_goodbye(const wire::Bye& bye, base::TimePoint arrived);

    /// Begins the session that all have agreed on; see Handshake::tell().
    void join(const Session& agreed, bool late, base::TimePoint now);
    /// Makes its newest state count no more, as between two sessions.
    void forget_state();

    /// Begins a tick, in which freshness() stays what it is now.
    void look(base::TimePoint now) { freshness_ = freshness_at(now); }
    /// The weight of its state in this tick: 1 while fresh, falling to 0 over the fade, and 0 when
    /// stale or unknown, or when the remote is gone.
    [[nodiscard]] double freshness() const { return freshness_; }
    [[nodiscard]] double freshness_at(base::TimePoint now) const;
    /// A change of its forces: they have just faded to zero, or the remote is heard again. Call
    /// change() once a tick.
    enum class Change : std::uint8_t { none, lost, back };
    [[nodiscard]] Change change(base::TimePoint now);

    /// The newest state; nullopt before the first one of the session.
    [[nodiscard]] const std::optional<wire::State>& state() const { return state_; }
    /// A body's state, from the newest message that had it; nullptr: there was none.
    [[nodiscard]] const wire::BodyState* body(std::uint16_t id) const;
    /// The body's state in a scene with only one body; see body(id).
    [[nodiscard]] const wire::BodyState* body() const
    {
        return count_ == 0 ? nullptr : &bodies_[0];
    }
    /// The number of bodies that it has told of.
    [[nodiscard]] std::size_t bodies_known() const { return count_; }
    /// The body that the newest state's hand pushes, by the impulse that it has given last.
    [[nodiscard]] const wire::BodyState* touched() const;
    [[nodiscard]] std::optional<base::TimePoint> arrived() const { return arrived_; }

    [[nodiscard]] const Handshake& handshake() const { return handshake_; }
    [[nodiscard]] Handshake& handshake() { return handshake_; }
    [[nodiscard]] const std::optional<Session>& session() const { return handshake_.session(); }
    /// The effect of the path to the remote and back since the session with it began. Nothing was
    /// measured where that was not asked for.
    [[nodiscard]] PathsReport paths() const { return meter_ ? meter_->report() : PathsReport{}; }
    /// The remote's id: as it was named, or as it has said; 0: neither.
    [[nodiscard]] std::uint16_t id() const { return id_ != 0 ? id_ : handshake_.id(); }
    /// True if the remote has said goodbye.
    [[nodiscard]] bool is_gone() const { return gone_; }
    /// Heard by hellos or states within `length` before now.
    [[nodiscard]] bool is_heard_within(base::Duration length, base::TimePoint now) const
    {
        return last_heard_ && now - *last_heard_ <= length;
    }
    /// True if the remote was silent for longer than `silence`, or is gone. It then does not delay
    /// the others any more.
    [[nodiscard]] bool counts_as_gone(base::Duration silence, base::TimePoint now) const;

    /// The number of the pair's session and of the last state to it.
    struct Numbering {
        std::uint32_t number = 0;
        std::uint32_t sequence = 0;
    };
    [[nodiscard]] const Numbering& numbering() const { return current_; }
    std::uint32_t next_sequence() { return ++current_.sequence; }
    /// True if its next state has the body although nothing moves: the first, and every 64th, or
    /// where not every tick has a state, one in 64 ticks.
    [[nodiscard]] bool is_body_due(base::TimePoint now, bool is_each_tick)
    {
        const bool is_due =
            current_.sequence % body_every == 1 ||
            (!is_each_tick && now - last_body_told_ >= base::Duration::rep{body_every} * tick_);
        if (is_due) last_body_told_ = now;
        return is_due;
    }

    void post(const auto& message)
    {
        outbox_.put([&message] { return wire::encode(message); });
    }
    /// The next datagram to be sent to it, valid until something is posted; nullptr: none.
    [[nodiscard]] const wire::Datagram* poll() { return outbox_.take(); }

private:
    void begin_session(base::TimePoint now);
    void take_bodies(const wire::State& state);
    [[nodiscard]] bool misses_body(const wire::State& state, base::TimePoint arrived);
    [[nodiscard]] base::TimePoint first_word_awaited_since() const
    {
        return std::max(session()->start, agreed_at_);
    }

    // Members that algorithms read in each tick come first.
    std::optional<wire::State> state_;
    std::array<wire::BodyState, wire::bodies_max> bodies_; // the first count_ are known
    std::size_t count_ = 0;
    std::size_t touched_ = 0; // index in bodies_ of the body that the hand pushes
    std::optional<base::TimePoint> arrived_;
    double freshness_ = 0.0;
    Staleness staleness_;
    Stale stale_;

    std::uint16_t id_;
    Handshake handshake_;
    SequenceGuard sequences_;
    TickCount tick_count_;
    std::unique_ptr<PathMeter> meter_;       // large; null unless Config::measures_path
    std::unique_ptr<PlayoutBuffer> playout_; // large; null unless Config::playout is adaptive
    base::Duration tick_;
    Outbox<wire::Datagram, 8> outbox_;
    Numbering current_;
    Numbering former_; // numbering of the session before
    base::TimePoint agreed_at_;
    std::optional<base::TimePoint> last_heard_; // arrival of the last hello or state

    bool gone_ = false;
    struct Goodbye {
        base::TimePoint heard;
        /// Send stamp of the remote's newest state by then, on the remote's clock.
        std::optional<base::TimePoint> last_sent;
    };
    Goodbye goodbye_;
    /// Arrival of the last state with a body, or when the session was agreed on.
    base::TimePoint last_body_;
    base::TimePoint last_body_told_; // when is_body_due() last returned true
    std::uint32_t states_without_body_ = 0;
    bool body_missed_ = false;     // missing bodies were reported
    bool lost_ = false;            // the remote fell silent
    std::uint32_t jumps_told_ = 0; // reported jumps of the clock of the remote's present run
};

} // namespace hapnet::peer

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

/// The times, from its arrival, for which the newest state of a remote holds and fades.
struct Staleness {
    base::Duration hold{std::chrono::milliseconds{250}};
    base::Duration fade{std::chrono::milliseconds{50}};
};

/// The treatment of a stale state: a duplicate, or a state that a newer one has overtaken.
enum class Stale : std::uint8_t { drop, take };
constexpr auto names_of(base::Tag<Stale> /*enum*/) { return base::names("drop", "take"); }

/// Another peer of the session, from the point of view of this one: the handshake with it, its
/// newest state (or the last to arrive if stale ones are taken), its goodbyes, and the datagrams
/// that wait to be sent to it. Between states, the last values are held. Messages are numbered
/// separately between any two peers.
class Remote {
public:
    /// The time after the start without a state after which the remote counts as silent.
    static constexpr base::Duration first_word_within{std::chrono::seconds{1}};
    /// The tolerance of sequence numbers, in ticks. If the path is slower in one direction, the two
    /// starts differ by half the difference of the delays, which no peer can measure. The tolerance
    /// is the delay of the slowest path that is accepted.
    static constexpr base::Duration::rep sequence_slack = 5000;
    /// At least one in this many states contains the bodies, even if nothing moves.
    static constexpr std::uint32_t body_every = 64;
    /// A state that was sent longer than this after a goodbye cancels it, because the goodbye must
    /// have been forged or damaged. States that the goodbye overtook on its way do not count.
    static constexpr base::Duration goodbye_doubted_for{std::chrono::milliseconds{300}};
    /// The number of states without a body, over at least a second, that shows that states with
    /// bodies are lost: one in 64 contains them even at rest.
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
        bool had_session = false; // there was a session before the hello
    };
    [[nodiscard]] Greeting on_hello(const wire::Hello& hello, base::TimePoint arrived);
    /// True if a hello with this id is from the remote that is expected here.
    [[nodiscard]] bool is_expected(std::uint16_t id) const { return id_ == 0 || id == id_; }

    /// True if the sequence number of a state is possible. The caller must have checked that the
    /// state is plausible otherwise.
    [[nodiscard]] bool can_be_numbered(const wire::State& state, base::TimePoint arrived) const;
    /// True if the remote continues after its goodbye. The goodbye is then forgotten.
    [[nodiscard]] bool takes_back_goodbye(const wire::State& state, base::TimePoint arrived);
    struct Heard {
        bool taken = false;       // the state was used; a stale one only with Stale::take
        bool body_missed = false; // true once if the remote's states lack bodies
    };
    /// Takes information about path and clock from a state that has arrived. Returns true if the
    /// remote's clock has jumped.
    bool on_arrival(const wire::State& state, base::TimePoint arrived);
    /// Takes a state that is valid from `at`, its arrival or its playout.
    [[nodiscard]] Heard on_state(const wire::State& state, base::TimePoint at);
    /// Returns the buffer in which the remote's states wait; nullptr if they are used on arrival.
    [[nodiscard]] PlayoutBuffer* playout() const { return playout_.get(); }
    /// Updates what algorithms see: the newest state. Returns false if the state is stale and
    /// dropped.
    bool update(const wire::State& state, base::TimePoint arrived);
    /// Returns the number of the remote's tick that a state describes, from 1 in the session.
    [[nodiscard]] TickCount::Counted tick_of(const wire::State& state)
    {
        return tick_count_.of(state, tick_);
    }
    /// Handles a state of another session. If nothing is heard in this session, a late hello of an
    /// earlier run may have switched this peer to that run. A hello from this peer then makes the
    /// present run answer.
    void on_state_of_another(base::TimePoint arrived)
    {
        if (session() && freshness_at(arrived) <= 0.0) handshake_.ask();
    }
    /// Handles a goodbye. Returns true only the first time in a session.
    [[nodiscard]] bool on_goodbye(const wire::Bye& bye, base::TimePoint arrived);

    /// Begins the session that all peers have agreed on; see Handshake::tell().
    void join(const Session& agreed, bool late, base::TimePoint now);
    /// Discards the remote's newest state, as between two sessions.
    void forget_state();

    /// Begins a tick, during which freshness() is constant.
    void look(base::TimePoint now) { freshness_ = freshness_at(now); }
    /// Returns the weight of the remote's state in this tick: 1 while it is fresh, falling to 0
    /// during the fade, and 0 when it is stale or unknown, or when the remote is gone.
    [[nodiscard]] double freshness() const { return freshness_; }
    [[nodiscard]] double freshness_at(base::TimePoint now) const;
    /// A change of the remote's forces: they have just faded to zero, or the remote is heard again.
    /// Call change() once a tick.
    enum class Change : std::uint8_t { none, lost, back };
    [[nodiscard]] Change change(base::TimePoint now);

    /// Returns the newest state; nullopt before the first one of the session.
    [[nodiscard]] const std::optional<wire::State>& state() const { return state_; }
    /// Returns the state of a body from the newest message that contained it; nullptr if none did.
    [[nodiscard]] const wire::BodyState* body(std::uint16_t id) const;
    /// Returns the state of the only body of a scene; see body(id).
    [[nodiscard]] const wire::BodyState* body() const
    {
        return count_ == 0 ? nullptr : &bodies_[0];
    }
    /// Returns the number of bodies that the remote has sent so far.
    [[nodiscard]] std::size_t bodies_known() const { return count_; }
    /// Returns the body that the hand of the newest state pushes. It is the body whose impulse has
    /// changed last.
    [[nodiscard]] const wire::BodyState* touched() const;
    [[nodiscard]] std::optional<base::TimePoint> arrived() const { return arrived_; }

    [[nodiscard]] const Handshake& handshake() const { return handshake_; }
    [[nodiscard]] Handshake& handshake() { return handshake_; }
    [[nodiscard]] const std::optional<Session>& session() const { return handshake_.session(); }
    /// Returns the effect of the path to the remote and back since the session with it began. The
    /// report is empty if measuring was not requested.
    [[nodiscard]] PathsReport paths() const { return meter_ ? meter_->report() : PathsReport{}; }
    /// Returns the remote's id, from the roster or from its hello; 0: neither is known.
    [[nodiscard]] std::uint16_t id() const { return id_ != 0 ? id_ : handshake_.id(); }
    /// True if the remote has said goodbye.
    [[nodiscard]] bool is_gone() const { return gone_; }
    /// True if a hello or state arrived within `length` before `now`.
    [[nodiscard]] bool is_heard_within(base::Duration length, base::TimePoint now) const
    {
        return last_heard_ && now - *last_heard_ <= length;
    }
    /// True if the remote was silent for longer than `silence`, or is gone. It then no longer
    /// delays the others.
    [[nodiscard]] bool counts_as_gone(base::Duration silence, base::TimePoint now) const;

    /// The number of the pair's session, and of the last state sent in it.
    struct Numbering {
        std::uint32_t number = 0;
        std::uint32_t sequence = 0;
    };
    [[nodiscard]] const Numbering& numbering() const { return current_; }
    std::uint32_t next_sequence() { return ++current_.sequence; }
    /// True if the next state to the remote has to contain the body although nothing moves: the
    /// first one and every 64th, or, if not every tick has a state, one in 64 ticks.
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
    /// Returns the next datagram to be sent to the remote, valid until another one is posted;
    /// nullptr if there is none.
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
    Numbering former_; // numbering of the previous session
    base::TimePoint agreed_at_;
    std::optional<base::TimePoint> last_heard_; // arrival of the last hello or state

    bool gone_ = false;
    struct Goodbye {
        base::TimePoint heard;
        /// The send stamp of the newest state that the remote had sent until then, on its clock.
        std::optional<base::TimePoint> last_sent;
    };
    Goodbye goodbye_;
    /// The arrival of the last state with a body, or the time of the agreement on the session.
    base::TimePoint last_body_;
    base::TimePoint last_body_told_; // when is_body_due() last returned true
    std::uint32_t states_without_body_ = 0;
    bool body_missed_ = false;     // missing bodies were reported
    bool lost_ = false;            // the remote fell silent
    std::uint32_t jumps_told_ = 0; // reported jumps of the clock of the remote's present run
};

} // namespace hapnet::peer

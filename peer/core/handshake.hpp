// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/clock_sync.hpp"
#include "proto/wire/message.hpp"

#include <algorithm>
#include <optional>

namespace hapnet::peer {

/// A peer's description of itself in the handshake. Its id, scene, tick rate and task must be
/// compatible with those of the other peer.
struct Introduction {
    std::uint16_t id = 1;
    std::uint32_t nonce = 1; // identifies this run of the program; unpredictable, not 0
    std::uint64_t scene_hash = 0;
    std::uint64_t seed = 0;
    std::uint16_t tick_rate_hz = 1000;
    wire::TaskName task;
    base::Duration length{std::chrono::seconds{30}}; // length of the session: Settings::length
    /// The name of this peer's clock: clock_hash(). Peers with equal ones share a clock. 0:
    /// unknown.
    std::uint32_t clock = 0;
    base::Duration clock_error{}; // the largest error of that clock; 0 within one machine
    wire::HandModel hand{};       // a value of 0 is unknown
};

/// The session that two peers have agreed on, from the point of view of one of them.
struct Session {
    std::uint32_t number = 0;
    base::TimePoint start; // on this peer's clock
    std::uint64_t seed = 0;
    base::Duration length{}; // the shorter of the lengths requested of the two peers
    bool is_left = false;    // this peer has the lower id
    /// True if this peer joined a running session, and takes over its bodies.
    bool joined_late = false;
};

/// Lets two peers find each other and agree on a start. Both send hellos every 20 ms until both
/// know the start. The peer with the lower id sets the start to one second after it learns that it
/// was heard, and repeats it until it is acknowledged. The remote joins when it learns of the
/// start, even if that is late. A peer that restarts joins the session that the other peer is still
/// in. Feed it with on_hello(), drain it with hello(), and read session() after either. Among more
/// than two peers, Others decides when to start, and every peer that knows the start sends it to
/// those that it meets.
class Handshake {
public:
    static constexpr base::Duration hello_every{std::chrono::milliseconds{20}};
    static constexpr base::Duration start_after{std::chrono::seconds{1}};
    /// The time without an answer after which a peer in a session sends hellos ten times as often.
    /// Otherwise, at 97 % loss one peer in five would learn of the start more than a second late.
    static constexpr base::Duration answer_within{std::chrono::milliseconds{500}};
    static constexpr base::Duration hello_every_unanswered{std::chrono::milliseconds{2}};

    /// The source of the start: the peer with the lower id of the two, or the whole session by
    /// tell().
    enum class StartSetBy : std::uint8_t { lower_id, session };
    explicit Handshake(const Introduction& introduction, StartSetBy by = StartSetBy::lower_id)
        : self_{introduction}, set_by_{by}
    {}

    /// While the known run of the remote is heard, hellos of any other run are ignored, because
    /// they may be forged. A new run repeats its hello until the previous run has fallen silent.
    enum class Known : std::uint8_t { silent, heard };
    /// The number of times in a row that a different start must be received before it replaces the
    /// agreed one, because one message may be damaged. In a pair this is possible only before the
    /// session has begun.
    static constexpr int starts_needed = 3;

    /// Takes a hello. Returns the reason if the two cannot play together.
    [[nodiscard]] std::optional<wire::ByeReason>
    on_hello(const wire::Hello& hello, base::TimePoint arrived, Known known = Known::silent);

    /// Takes the clock echo of any message from the remote.
    void on_echo(const std::optional<wire::Echo>& echo, base::TimePoint sent,
                 base::TimePoint arrived);

    /// Notes that a state of this session has arrived, which shows that the remote knows the start.
    void on_state() { acknowledged_ = true; }
    /// Requests another hello although everything seems to be settled. The remote answers if it
    /// knows otherwise.
    void ask() { asked_ = true; }

    [[nodiscard]] bool is_hello_due(base::TimePoint now) const
    {
        const bool settled =
            session_ && !starts_differ_ && (owns_start_ ? acknowledged_ : start_heard_.has_value());
        const base::Duration every = is_unanswered(now) ? hello_every_unanswered : hello_every;
        return (!settled || asked_) && !(last_hello_ && now - *last_hello_ < every);
    }
    /// Returns the hello that is due, if any. `heard` lists the peers that this one hears: bit i
    /// for id i.
    [[nodiscard]] std::optional<wire::Hello> hello(base::TimePoint now, std::uint32_t heard);

    /// Takes over the start, seed and length of the whole session, and sends them to the remote,
    /// which must have been met. `late` tells the remote that it joins a running session. A changed
    /// start is repeated until the remote repeats it.
    void tell(const Session& agreed, bool late);
    /// Returns, with more than two peers, the session of the remote, if it has reported
    /// `starts_needed` times that it began earlier than the session known here, and it is not over.
    /// See `is_same()`.
    [[nodiscard]] const std::optional<Session>& earlier() const { return earlier_; }
    /// True if two starts that are `apart` count as equal, given the uncertainty of the clocks. A
    /// start that came through another peer was converted three times, and each clock has drifted.
    [[nodiscard]] static bool is_same(base::Duration apart, base::Duration uncertainty)
    {
        return std::chrono::abs(apart) <= std::chrono::milliseconds{20} + 4 * uncertainty;
    }

    /// Returns the clock echo for the next message to the remote.
    [[nodiscard]] std::optional<wire::Echo> echo(base::TimePoint now) const;

    [[nodiscard]] const std::optional<Session>& session() const { return session_; }
    /// Returns the remote's clock for prediction; nullopt before the first echo, and while in
    /// doubt.
    [[nodiscard]] std::optional<ClockEstimate> clock() const { return clock_.trusted(); }
    /// Returns the measurements behind clock().
    [[nodiscard]] const ClockSync& clock_sync() const { return clock_; }
    /// True if the present run of the remote has been heard.
    [[nodiscard]] bool has_met() const { return remote_.has_value(); }
    /// Returns the remote's id; 0 before it was met.
    [[nodiscard]] std::uint16_t id() const { return remote_ ? remote_->id : std::uint16_t{0}; }
    /// Returns the remote's description of its hand. Properties that it has not given are 0.
    [[nodiscard]] wire::HandModel hand() const
    {
        return remote_ ? remote_->hand : wire::HandModel{};
    }
    /// True if the remote has heard the present run of this peer.
    [[nodiscard]] bool is_heard_there() const { return remote_ && remote_->hears_us; }
    /// Returns the peers that the remote hears: bit i for id i.
    [[nodiscard]] std::uint32_t heard_there() const { return remote_ ? remote_->heard : 0; }
    /// Returns the shorter of the session lengths that the two peers request.
    [[nodiscard]] base::Duration length() const;

private:
    struct RemotePeer {
        std::uint32_t nonce = 0;
        std::uint16_t id = 0;
        bool hears_us = false;
        std::uint32_t heard = 0;
        std::uint32_t length_ms = 0;
        wire::HandModel hand{};
    };

    [[nodiscard]] std::optional<wire::ByeReason> refusal_of(const wire::Hello& hello) const;
    /// True if the remote should have learnt of the start long ago, but seems not to know it.
    [[nodiscard]] bool is_unanswered(base::TimePoint now) const
    {
        return session_ && owns_start_ && !acknowledged_ &&
               now - std::max(session_->start, met_at_) > answer_within;
    }
    void meet(const wire::Hello& hello);
    [[nodiscard]] bool is_left() const;
    [[nodiscard]] std::uint32_t number() const;
    void agree(const wire::Hello& hello, base::TimePoint arrived);
    void agree_with_all(const wire::Hello& hello, base::TimePoint arrived);
    void compare_starts(const wire::Hello& hello, base::TimePoint arrived);
    [[nodiscard]] std::optional<base::Duration> later_there() const;
    [[nodiscard]] bool has_come_often(base::TimePoint start);
    void propose(base::TimePoint start);
    void adopt(const wire::Hello& hello, base::TimePoint arrived);
    [[nodiscard]] bool may_replace_start(base::TimePoint start, base::TimePoint arrived);

    Introduction self_;
    StartSetBy set_by_;
    std::optional<RemotePeer> remote_;
    base::TimePoint met_at_; // when this run of the remote was first heard
    ClockSync clock_;
    std::optional<wire::Echo> last_heard_; // the message to echo, without `age`: see last_heard_at_
    base::TimePoint last_heard_at_;
    std::optional<Session> session_;
    bool owns_start_ = false;                    // this side decides the start
    bool stayed_ = false;                        // this side was in session before the remote
    bool acknowledged_ = false;                  // the remote knows the start
    bool asked_ = true;                          // a hello is requested although all is settled
    std::optional<base::TimePoint> start_heard_; // the remote's start, on its clock
    std::optional<base::TimePoint> other_start_; // another start that the remote has sent
    int times_other_start_ = 0;
    bool starts_differ_ = false;     // with more than two peers: their starts differ
    std::optional<Session> earlier_; // earlier session that the remote is in
    std::optional<base::TimePoint> last_hello_;
};

} // namespace hapnet::peer

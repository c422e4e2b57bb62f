// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/clock_sync.hpp"
#include "proto/wire/message.hpp"

#include <algorithm>
#include <optional>

namespace hapnet::peer {

/// A peer's own description for the handshake. Id, scene, tick rate and task must suit the other
/// side's.
struct Introduction {
    std::uint16_t id = 1;
    std::uint32_t nonce = 1; // identifies this run of the program; unpredictable, not 0
    std::uint64_t scene_hash = 0;
    std::uint64_t seed = 0;
    std::uint16_t tick_rate_hz = 1000;
    wire::TaskName task;
    base::Duration length{std::chrono::seconds{30}}; // length of the session: Settings::length
    /// Hash of this machine's boot id; peers with equal ones share a clock. 0: unknown.
    std::uint32_t boot = 0;
    wire::HandModel hand{}; // a value of 0 is unknown
};

/// The session two peers have agreed on, as one of them sees it.
struct Session {
    std::uint32_t number = 0;
    base::TimePoint start; // on this peer's clock
    std::uint64_t seed = 0;
    base::Duration length{}; // the shorter of the lengths that the two peers were asked for
    bool is_left = false;    // this peer has the lower id
    /// This peer came to a session that was under way, and takes over its bodies.
    bool joined_late = false;
};

/// Lets two peers find each other and agree on a start: hellos every 20 ms until both know it. The
/// lower id sets the start one second after it learns that it was heard, and repeats the start
/// until it is acknowledged. The remote joins when it hears of the start, even if that is late. A
/// peer that restarts meets one that is in session already and joins that session. Feed with
/// on_hello(), drain with hello(), and read session() after either. Among more than two Others
/// decides when to start, and every peer that knows the start tells it to those that it meets.
class Handshake {
public:
    static constexpr base::Duration hello_every{std::chrono::milliseconds{20}};
    static constexpr base::Duration start_after{std::chrono::seconds{1}};
    /// The time without an answer after which a side in session says hello ten times as often: at
    /// 97 % loss one in five would otherwise learn of the start more than a second late.
    static constexpr base::Duration answer_within{std::chrono::milliseconds{500}};
    static constexpr base::Duration hello_every_unanswered{std::chrono::milliseconds{2}};

    /// The peer that sets the start: the lower id of the two, or all of the session by tell().
    enum class StartSetBy : std::uint8_t { lower_id, session };
    explicit Handshake(const Introduction& introduction, StartSetBy by = StartSetBy::lower_id)
        : self_{introduction}, set_by_{by}
    {}

    /// While the run that was met is heard, the hello of any other run is ignored: it may be
    /// forged. A new run keeps saying hello until the former one has fallen silent.
    enum class Known : std::uint8_t { silent, heard };
    /// The number of times in a row that another start must come to replace the one agreed on: the
    /// first may have been damaged. In a pair it can do so only before the session has begun.
    static constexpr int starts_needed = 3;

    /// Takes a hello in. Returns why the two cannot play together, if so.
    [[nodiscard]] std::optional<wire::ByeReason>
    on_hello(const wire::Hello& hello, base::TimePoint arrived, Known known = Known::silent);

    /// Takes the clock echo of any message of the remote.
    void on_echo(const std::optional<wire::Echo>& echo, base::TimePoint sent,
                 base::TimePoint arrived);

    /// A state of this session arrived: the remote knows the start.
    void on_state() { acknowledged_ = true; }
    /// Says hello once more although all seems to be settled; the remote answers where it knows
    /// better.
    void ask() { asked_ = true; }

    [[nodiscard]] bool is_hello_due(base::TimePoint now) const
    {
        const bool settled =
            session_ && !starts_differ_ && (owns_start_ ? acknowledged_ : start_heard_.has_value());
        const base::Duration every = is_unanswered(now) ? hello_every_unanswered : hello_every;
        return (!settled || asked_) && !(last_hello_ && now - *last_hello_ < every);
    }
    /// The hello that is due, if one is. `heard`: the peers that this one hears, bit i for id i.
    [[nodiscard]] std::optional<wire::Hello> hello(base::TimePoint now, std::uint32_t heard);

    /// Takes over the start, seed and length that all have agreed on, and sends them to the remote,
    /// which must have been met. A remote that is met `late` learns that it joins. A changed start
    /// is repeated until the remote repeats it, too.
    void tell(const Session& agreed, bool late);
    /// Among more than two: the session that the remote is in, when it has told `starts_needed`
    /// times that this began earlier than the one known here, and it is not over. See `is_same()`.
    [[nodiscard]] const std::optional<Session>& earlier() const { return earlier_; }
    /// True if two starts count as one, by their distance and the uncertainty of the clocks: a
    /// start that came by way of another peer was converted three times, and each clock has moved.
    [[nodiscard]] static bool is_same(base::Duration apart, base::Duration uncertainty)
    {
        return std::chrono::abs(apart) <= std::chrono::milliseconds{20} + 4 * uncertainty;
    }

    /// The clock echo for the next message to the remote.
    [[nodiscard]] std::optional<wire::Echo> echo(base::TimePoint now) const;

    [[nodiscard]] const std::optional<Session>& session() const { return session_; }
    /// The remote's clock, to predict from: nullopt before the first echo, and while in doubt.
    [[nodiscard]] std::optional<ClockEstimate> clock() const { return clock_.trusted(); }
    /// The measurements behind clock().
    [[nodiscard]] const ClockSync& clock_sync() const { return clock_; }
    /// True if the remote has been heard in this run of it.
    [[nodiscard]] bool has_met() const { return remote_.has_value(); }
    /// The remote's id; 0 before it was met.
    [[nodiscard]] std::uint16_t id() const { return remote_ ? remote_->id : std::uint16_t{0}; }
    /// The remote's hand, as far as it has described it.
    [[nodiscard]] wire::HandModel hand() const
    {
        return remote_ ? remote_->hand : wire::HandModel{};
    }
    /// True if it has heard this run of us.
    [[nodiscard]] bool is_heard_there() const { return remote_ && remote_->hears_us; }
    /// The peers that the remote hears, bit i for id i.
    [[nodiscard]] std::uint32_t heard_there() const { return remote_ ? remote_->heard : 0; }
    /// The session's length as far as the two are concerned: the shorter one.
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
    /// True if the remote should long have known the start, and does not seem to.
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
    base::TimePoint met_at_; // when this run of the remote was met
    ClockSync clock_;
    std::optional<wire::Echo> last_heard_; // message to echo; `age` unused, see last_heard_at_
    base::TimePoint last_heard_at_;
    std::optional<Session> session_;
    bool owns_start_ = false;                    // this side decides the start
    bool stayed_ = false;                        // this side was in session before the remote
    bool acknowledged_ = false;                  // the remote knows the start
    bool asked_ = true;                          // a hello is wanted although all is settled
    std::optional<base::TimePoint> start_heard_; // the remote's start, on its clock
    std::optional<base::TimePoint> other_start_; // another start that the remote told
    int times_other_start_ = 0;
    bool starts_differ_ = false;     // with more than two peers: the two tell different starts
    std::optional<Session> earlier_; // earlier session that the remote is in
    std::optional<base::TimePoint> last_hello_;
};

} // namespace hapnet::peer

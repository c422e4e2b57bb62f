// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/circle.hpp"
#include "peer/core/effect_sums.hpp"
#include "peer/core/finger_friction.hpp"
#include "peer/core/intention.hpp"
#include "peer/core/shared_body.hpp"
#include "peer/core/sync/algorithm.hpp"
#include "peer/core/sync/shared_poses.hpp"
#include "proto/record/rows.hpp"

#include <optional>
#include <span>
#include <vector>

namespace hapnet::peer {

/// A hand as its device reports it: the haptic interface point and whether the hand grips.
struct Hand {
    base::Position hip;
    base::Velocity velocity;
    bool gripping = false;
    bool present = true; // a person holds the device, and its sample is valid
    double work_j = 0.0; // of the hand on its device since the start
    base::Force felt{};  // that the device was told in the tick before
};

struct Settings {
    Introduction introduction;
    Roster roster; // the others; with more than one: plays_with_many()
    scene::Description scene = scene::paper_scene(); // one that shared_bodies() accepts
    Algorithm algorithm; // one that check_bodies_of() and check_hands_of() accept
    /// Damping of the device and the loosest grip on it. It bounds the contacts that can be
    /// rendered without the hand drawing energy from them (passive_share). The default is a nominal
    /// grip on a stylus, and an assumption: fingertips were measured at 4 to 7.4 N s/m (A. Z.
    /// Hajian, R. D. Howe: Identification of the mechanical impedance at the human finger tip,
    /// 1997).
    double grip_damping_ns_per_m = 4.0;
    /// Stiffest contact that the device renders without buzzing, in the scene; 0: not known.
    double stiffness_max_n_per_m = 0.0;
    /// Metres in the scene for each metre that the hand moves.
    double mount_scale = 1.0;
    Staleness staleness;
    base::Duration tick{std::chrono::milliseconds{1}};
    base::Duration length{std::chrono::seconds{30}}; // of the session, from its start
    bool measures_paths = false;                     // to the others, for statistics; 80 KiB each
};

/// The phase of a session. Its last 3 s (half of it, when it is shorter than 6 s) are hands off.
using record::Phase;

/// An event that a person should be told of.
enum class Event : std::uint8_t {
    met,       // the other side answers
    agreed,    // the start is known
    started,   // the session has begun
    joined,    // ... and was under way already: the body is where the other side has it
    lost,      // silent for long enough that the forces faded to zero
    back,      // heard again
    restarted, // the other side came back as a new run
    left,      // the other side said goodbye
    refused,   // the two cannot play together: see refusal()
    hands_off,
    ended,
    stopped,      // before there was a session
    no_body,      // states come, but none that tells where the body is
    clock_jumped, // the other side's, against this one
};

/// Counters of received messages, and of those that could not be used.
struct Counters {
    std::uint64_t states = 0; // taken
    std::uint64_t hellos = 0;
    std::uint64_t byes = 0;
    std::uint64_t outdated = 0; // older than one already known, or duplicates, and dropped
    std::uint64_t other_session = 0;
    std::uint64_t malformed = 0;
    std::uint64_t other_version = 0;
    std::uint64_t implausible = 0;   // out of any scene's reach, or numbered ahead of time
    std::uint64_t unusable_hand = 0; // ticks in which the device's sample was not usable
    std::uint64_t sent = 0;
};

/// An event, and the id of the other that it is about; 0: it is about all, or that one's id is not
/// known.
struct Notice {
    Event event = Event::met;
    std::uint16_t about = 0;
};

/// The result of one tick.
struct Tick {
    Phase phase = Phase::waiting;
    bool permitted = false; // whether the hand may feel anything at all
    base::Force force;      // on the hand, before the governor
    scene::HandTouch touched;
    bool remote_touching = false;             // the hand of one of the others
    base::Force remote_force;                 // that counted, of all the others
    std::optional<base::Position> remote_hip; // as the algorithm shows it
    double freshness = 0.0;                   // of the others' newest state
    std::uint32_t sequence = 0;               // of the state that was sent to the first; 0: none
};

/// One peer without device, socket or clock: its copy of the scene, its hand, what it knows of
/// the others, and the session with them. They share the movable bodies of the scene. Call
/// on_datagram() for what arrives, tick() once per millisecond, and then poll() for each of the
/// others and notice() until they are empty.
class Peer {
public:
    static constexpr base::Duration hands_off_length{std::chrono::seconds{3}};
    /// Among more than two, one that was silent for so long counts as gone until it is heard again:
    /// the others play on. Until then its hand may be on the body.
    static constexpr base::Duration gone_after{std::chrono::seconds{1}};
    static constexpr base::Duration body_lingers{std::chrono::seconds{1}};
    /// For this long after its last touch, a hand is taken to have caused the body's motion.
    static constexpr base::Duration push_lasts{std::chrono::milliseconds{200}};
    static constexpr int byes = 5;
    static constexpr base::Duration bye_every{std::chrono::milliseconds{5}};
    /// A refusal counts when it came three times, at least this far apart: one damaged datagram
    /// must not end a session.
    static constexpr int refusals_needed = 3;
    static constexpr base::Duration refusal_every{std::chrono::milliseconds{4}};

    /// The scene must be one that shared_bodies() and World::freeze() accept.
    explicit Peer(const Settings& settings);

    /// `from`: which of the others sent it, in the order of the roster.
    void on_datagram(std::span<const std::byte> datagram, base::TimePoint arrived,
                     std::size_t from = 0);
    /// The result stays until the next call.
    const Tick& tick(base::TimePoint now, const Hand& hand);
    /// That of the last call.
    [[nodiscard]] const Tick& last() const { return tick_; }

    /// The next datagram for one of the others, valid until on_datagram() or tick(); nullptr: there
    /// is none.
    [[nodiscard]] const wire::Datagram* poll(std::size_t to = 0)
    {
        return circle_.members()[to].poll();
    }
    /// Likewise what a person should be told.
    [[nodiscard]] const Notice* notice() { return notices_.take(); }

    /// Ends the session: byes follow, then finished() holds.
    void leave(wire::ByeReason reason);
    /// Nothing more will come of this peer.
    [[nodiscard]] bool finished() const { return leaving_ && byes_left_ == 0; }

    [[nodiscard]] const scene::World& world() const { return world_; }
    /// All of them: every movable body of the scene, by their ids.
    [[nodiscard]] std::span<const SharedBody> shared() const { return shared_; }
    /// Whose copy of the i-th of them counts: SharedPoses::owner(); 0 where one is shared that does
    /// not turn.
    [[nodiscard]] std::uint16_t owner(std::size_t body) const
    {
        return poses_ ? poses_->owner(body) : std::uint16_t{0};
    }
    /// The first shared body in this copy of the scene.
    [[nodiscard]] scene::BodyState body() const { return world_.body(body_); }
    [[nodiscard]] base::Position position() const { return world_.position(body_); } // of body()
    [[nodiscard]] base::Velocity velocity() const { return world_.velocity(body_); }
    [[nodiscard]] const std::optional<Session>& session() const { return circle_.session(); }
    [[nodiscard]] std::span<const Member> others() const { return circle_.members(); }
    [[nodiscard]] std::optional<ClockEstimate> clock(std::size_t of = 0) const
    {
        return others()[of].handshake().clock();
    }
    [[nodiscard]] const Algorithm& algorithm() const { return settings_.algorithm; }
    [[nodiscard]] const Counters& counters() const { return counters_; }
    [[nodiscard]] bool is_alone() const; // all others said goodbye
    /// Its place among all in the order of their ids, from 0: the 1st, 3rd, ... hand acts as L, the
    /// others as R.
    [[nodiscard]] std::size_t rank() const { return circle_.rank(); }
    [[nodiscard]] bool is_left() const { return rank() % 2 == 0; }
    /// One of so many that act on its side.
    [[nodiscard]] double share_of_side() const
    {
        const std::size_t all = others().size() + 1;
        return 1.0 / static_cast<double>(is_left() ? all - all / 2 : all / 2);
    }
    [[nodiscard]] std::optional<wire::ByeReason> refusal() const { return refusal_; }
    /// Time from the start until the hands let go.
    [[nodiscard]] base::Duration hands_on() const;
    /// What was agreed on; before that what this peer was asked for.
    [[nodiscard]] base::Duration length() const
    {
        return session() ? session()->length : settings_.length;
    }

private:
    /// A reason why the two cannot play together, until it has come often enough.
    struct PendingRefusal {
        wire::ByeReason reason = wire::ByeReason::finished;
        std::uint32_t about = 0; // the nonce or version that is refused
        int times{};
        base::TimePoint last{};
    };

    void on_message(const wire::Hello& hello, base::TimePoint arrived, std::size_t from);
    void on_message(const wire::State& state, base::TimePoint arrived, std::size_t from);
    void on_message(const wire::Bye& bye, base::TimePoint arrived, std::size_t from);
    [[nodiscard]] bool is_plausible(const wire::State& state) const;
    void forget(std::size_t other);
    void consider_refusal(const PendingRefusal& refusal, base::TimePoint arrived);
    void tell(Event event, const Member* about = nullptr);

    [[nodiscard]] Phase phase_at(base::TimePoint now) const;
    void note(Phase phase, base::TimePoint now);
    void play(Tick& tick, base::TimePoint now, const Hand& hand);
    [[nodiscard]] std::size_t chief() const;
    void take_bodies_over();
    [[nodiscard]] bool is_shared(const wire::BodyState& body) const;
    [[nodiscard]] bool are_others_fresh(base::TimePoint now) const;
    void move_world(Tick& tick, const Situation& situation, const scene::HandInput& hand);
    void keep_within_reach();
    void note_places();
    void account(const Tick& tick, base::TimePoint now);
    void account_for(std::size_t body, SharedPoses::Mover mover, const Tick& tick,
                     base::TimePoint now);
    void add_push(std::size_t body, const scene::HandTouch& touch);
    [[nodiscard]] wire::BodyState body_state(std::size_t body) const;
    [[nodiscard]] BodySet bodies_to_say(bool all, base::TimePoint now) const;
    void say_states(Tick& tick, base::TimePoint now, const Hand& hand);
    void say_bye(base::TimePoint now);
    [[nodiscard]] bool body_stirs(std::size_t body, base::TimePoint now) const;

    /// What this hand does to one of the shared bodies.
    struct Effect {
        EffectSums sums;
        std::optional<base::TimePoint> last_touch; // by this hand
        std::optional<base::TimePoint> last_stir;  // the body was touched or moved
        base::Position place_before;               // at the start of the tick
        glm::dquat orientation_before{1.0, 0.0, 0.0, 0.0};
    };

    Settings settings_;
    Circle circle_;
    std::vector<Other> others_; // of this tick, as the algorithm is to see them
    std::vector<SharedBody> shared_;
    scene::BodyId body_;               // the first of them
    std::optional<SharedPoses> poses_; // unless they are one without turning
    scene::World world_;
    std::optional<FingerFriction> friction_; // where the scene's hands have any
    Intention intention_;                    // of this hand
    double force_max_n_;                     // of the remote hand
    double share_;                           // of the forces on the hand, that may be rendered
    double remote_reach_m_;                  // of what the other side may claim
    std::vector<Effect> effects_;            // on the shared bodies
    Outbox<Notice, 32> notices_;
    Counters counters_;
    std::int64_t ticks_played_ = 0; // in the session
    Tick tick_;                     // the last

    Phase phase_ = Phase::waiting;
    bool body_known_ = true; // false: joined late, the others' bodies not all seen yet
    std::optional<PendingRefusal> pending_refusal_;
    std::optional<wire::ByeReason> refusal_;
    bool leaving_ = false;
    wire::ByeReason leaving_because_ = wire::ByeReason::finished;
    int byes_left_ = byes;
    std::optional<base::TimePoint> last_bye_;
};

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/time.hpp"
#include "proto/secure/door.hpp"
#include "proto/secure/entropy.hpp"
#include "proto/secure/fair_queue.hpp"
#include "proto/secure/frames.hpp"
#include "proto/secure/initiation_dates.hpp"
#include "proto/secure/noise_kk.hpp"
#include "proto/secure/transport.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

namespace hapnet::secure {

/// The two clocks at one moment: the monotonic clock, and the date. A handshake contains the date,
/// so that an old handshake is recognised.
struct Moment {
    base::TimePoint now;
    std::int64_t unix_ns = 0;
};

/// The sealed connection between one peer and another. Makes keys when the two meet, makes new keys
/// every two minutes and after silence, opens messages that are sealed with these keys, and tracks
/// the address of the other side. Does no I/O and reads no clock: feed it with on_datagram() and
/// tick(), drain it with poll(). A call of tick() does at most one multiplication on the curve. All
/// memory is allocated at construction.
///
/// A refused handshake message does not end the handshake, because the genuine message may still
/// arrive. Messages with the right MAC wait to be read, an initiation for one tick and a response
/// for two. If more than `waiting_max` wait, an unbiased choice of them is kept. With 1000 forged
/// messages a second from a member of the circle, about one genuine message in four is read, and
/// each is repeated 50 times a second.
///
/// The lower id wins when both sides begin at the same time. The responder uses the old key until a
/// message opens under the new one. The initiator sends a message under the new key until it is
/// answered. A key belongs to one run of each side, so it identifies their session.
class Association {
public:
    static constexpr base::Duration silence{std::chrono::seconds{1}};
    static constexpr base::Duration rekey_after{std::chrono::seconds{120}};
    static constexpr base::Duration rekey_spread{std::chrono::seconds{10}};
    static constexpr base::Duration key_lasts{std::chrono::seconds{3600}};
    static constexpr base::Duration previous_lasts{std::chrono::seconds{10}};
    static constexpr base::Duration repeat_every{std::chrono::milliseconds{20}};
    static constexpr base::Duration repeat_slowly_every{std::chrono::milliseconds{200}};
    static constexpr base::Duration repeat_slowly_after{std::chrono::seconds{10}};
    static constexpr base::Duration fresh_after = InitiationDates::unconfirmed_lasts;
    static constexpr base::Duration listen_for{std::chrono::seconds{1}};
    static constexpr int response_repeats = 2;
    static constexpr std::size_t waiting_max = 8; // for initiations and for responses each
    /// The shortest interval at which another run of the other side can replace the present one
    /// while the present one is heard.
    static constexpr base::Duration runs_change_every{std::chrono::seconds{5}};

    struct Config {
        std::uint8_t own_id = 0, other_id = 0; // never equal
        std::array<std::byte, 8> circle{};     // identifies the circle; equal on both sides
        std::uint32_t run = 0;                 // number of this program's run, never 0
        std::optional<Place> place;            // address of the other side, if given
        bool may_roam = true;                  // the other side may change its address
        std::uint32_t (*session_of)(std::uint32_t low_run, std::uint32_t high_run) = nullptr;
    };
    /// `seed` must be random, and must not be used for anything else.
    Association(const Config& config, StaticKeys keys, Secret seed);
    Association(const Association&) = delete;
    Association& operator=(const Association&) = delete;
    ~Association() = default;

    /// True if a datagram claims to belong to this association: it names one of its keys or
    /// handshakes, or begins a handshake from the other side. This proves nothing about its sender.
    [[nodiscard]] bool is_named_by(Bytes datagram) const;

    /// An opened message. The first bytes of the datagram are now the plain message.
    struct Received {
        std::size_t size = 0;
        std::uint32_t other_run = 0;
    };
    /// Opens a message in place, or takes a part of a handshake.
    std::optional<Received> on_datagram(std::span<std::byte> datagram, const Place& from,
                                        base::TimePoint now);
    /// Continues handshakes, and begins one when it is due.
    void tick(Moment moment);

    struct Outgoing {
        HandshakeFrame frame;
        Place to{};
    };
    /// Returns the next message of a handshake to send.
    [[nodiscard]] std::optional<Outgoing> poll();

    /// Seals a plain message in place; `room` must have `control_overhead` more bytes. nullopt:
    /// there is no key, so the message must not be sent.
    [[nodiscard]] std::optional<std::size_t> seal(std::span<std::byte> room, std::size_t size,
                                                  base::TimePoint now);
    [[nodiscard]] bool has_key(base::TimePoint now) const;
    /// Returns the address to send to; nullopt if no address was given and the other side has not
    /// been heard yet.
    [[nodiscard]] const std::optional<Place>& place() const { return place_; }
    [[nodiscard]] std::optional<base::Duration> key_age(base::TimePoint now) const;

    struct Counts {
        std::uint64_t handshakes = 0;
        std::uint64_t rekeys = 0;
        std::uint64_t forged = 0;
        std::uint64_t replayed = 0;
        std::uint64_t unsealed = 0;
        std::uint64_t unknown_key = 0;
        std::uint64_t other_circle = 0; // handshakes without the pre-shared key, or for other peers
        std::uint64_t refused = 0;      // messages that failed later, including forged ones
        std::uint64_t unread = 0;
        std::uint64_t cookies = 0;
        std::uint64_t roamed = 0;
        std::uint64_t not_sealed = 0;
        base::Duration last_handshake{}; // 0: this side has begun none that was completed

        /// Adds the counts of another association, and keeps the longer of the two times.
        Counts& operator+=(const Counts& other);
    };
    [[nodiscard]] const Counts& counts() const { return counts_; }

private:
    /// The keys that one handshake made, and the state of their use.
    struct Epoch {
        Epoch(KeyIndex own_index, KeyIndex other_index, NoiseKk::TransportKeys keys,
              std::uint32_t run, std::uint32_t number, base::TimePoint now)
            : own{own_index},
              other{other_index},
              sealer{std::move(keys.to_other)},
              opener{std::move(keys.from_other)},
              other_run{run},
              session{number},
              made{now}
        {}

        KeyIndex own, other;
        Sealer sealer;
        Opener opener;
        std::uint32_t other_run;
        std::uint32_t session;
        base::TimePoint made;
        std::uint32_t controls = 0;    // number of sealed control messages
        bool has_opened_state = false; // false: hellos still update the address of the other side
    };
    /// A handshake message with the right MAC that waits to be read.
    struct WaitingInitiation {
        KeyIndex sender = 0;
        Mac cause{}; // first MAC of the initiation
        std::array<std::byte, initiation_noise_bytes> noise{};
        Place from{};
    };
    struct WaitingResponse {
        KeyIndex sender = 0;
        std::array<std::byte, response_noise_bytes> noise{};
        Place from{};
    };
    struct Initiating {
        Initiating(KeyIndex index, const StaticKeys& keys, Bytes prologue, Secret ephemeral,
                   base::TimePoint now)
            : own{index}, noise{Role::initiator, keys, prologue, std::move(ephemeral)}, began{now}
        {}

        KeyIndex own;
        NoiseKk noise;
        base::TimePoint began;
        std::optional<HandshakeFrame> frame; // the initiation, once written
        std::optional<base::TimePoint> last_sent;
        bool has_new_cookie = false;
        FairQueue<WaitingResponse, waiting_max> responses;
        std::optional<KeyIndex> other; // sender of the response that is being read
        Place answered_from{};

        /// True if step_initiation() has work to do.
        [[nodiscard]] bool has_work() const { return !frame || other || !responses.is_empty(); }
    };
    struct Responding {
        Responding(KeyIndex own_index, const WaitingInitiation& initiation, const StaticKeys& keys,
                   Bytes prologue, Secret ephemeral);

        KeyIndex own, other;
        NoiseKk noise;
        Mac cause{}; // first MAC of the initiation
        Place to{};
        bool is_writing = false;
        std::uint32_t other_run = 0;
        std::int64_t date = 0;
    };
    struct Answer {
        HandshakeFrame frame;
        Mac cause{};
        Place to{};
        int repeats_left = 0;
        base::TimePoint repeat_at{};
    };

    std::optional<Received> on_message(std::span<std::byte> datagram, KeyIndex index,
                                       const Place& from, base::TimePoint now);
    void on_initiation(Bytes datagram, const Place& from, base::TimePoint now);
    void on_response(Bytes datagram, const Place& from);
    void move_to(const Place& place);
    void on_cookie_reply(Bytes datagram, base::TimePoint now);
    void step_response(base::TimePoint now);
    void step_initiation(Moment moment);
    void end_initiating();
    void read_next_initiation();
    void read_next_response();
    [[nodiscard]] Place answer_place(const Place& from) const;
    [[nodiscard]] std::uint32_t drawn();
    [[nodiscard]] std::int64_t date(Moment moment);
    [[nodiscard]] bool take_initiation(base::TimePoint now);
    [[nodiscard]] bool pushes_another_out(base::TimePoint now) const;
    void answer(base::TimePoint now);
    void send_answer(base::TimePoint now);
    void begin(Moment moment);
    void repeat(base::TimePoint now);
    void repeat_answer(base::TimePoint now);
    void confirm(base::TimePoint now);
    void use(Epoch epoch, base::TimePoint now);
    void send(const HandshakeFrame& frame, const Place& to);
    [[nodiscard]] bool needs_key(base::TimePoint now) const;
    [[nodiscard]] bool waits_for_confirmation(base::TimePoint now) const;
    [[nodiscard]] bool is_lower() const { return config_.own_id < config_.other_id; }
    [[nodiscard]] std::uint32_t session_with(std::uint32_t other_run) const;
    [[nodiscard]] KeyIndex fresh_index();
    [[nodiscard]] const Epoch* epoch_of(KeyIndex index) const;
    [[nodiscard]] Epoch* epoch_of(KeyIndex index);

    Config config_;
    StaticKeys keys_;
    Entropy entropy_;
    std::array<std::byte, 18> prologue_{};
    Hash other_mac1_key_;
    Door door_;
    CookieJar cookies_;
    std::optional<Place> place_;

    // At most three sets of keys: the present one, one that the other side has not confirmed yet,
    // and one that expires soon.
    std::optional<Epoch> current_, next_, previous_;
    std::int64_t next_date_ = 0; // date of the initiation that made next_
    base::TimePoint previous_until_;
    base::TimePoint last_opened_;
    base::TimePoint run_since_; // start of the present run of the other side

    std::optional<Initiating> initiating_;
    std::optional<base::TimePoint> unanswered_since_;
    /// The date of this side's last initiation.
    std::int64_t own_date_ = std::numeric_limits<std::int64_t>::min();
    base::TimePoint listens_until_;
    std::optional<base::TimePoint> confirm_at_; // next confirmation; nullopt: none due
    FairQueue<WaitingInitiation, waiting_max> initiations_;
    std::optional<Responding> responding_;
    bool is_turn_to_initiate_ = false; // next to continue if initiating and responding have work
    std::optional<Answer> answered_;
    std::optional<base::TimePoint> unconfirmed_since_; // first answer since the last handshake
    InitiationDates dates_;

    std::array<Outgoing, 4> outgoing_{};
    std::size_t outgoing_count_ = 0;
    Counts counts_;
};

constexpr auto fields_of(base::Tag<Association::Counts>)
{
    using C = Association::Counts;
    return base::fields(
        "association", base::member("handshakes", &C::handshakes, "Handshakes that made a key."),
        base::member("rekeys", &C::rekeys, "Those of them between the same runs."),
        base::member("forged", &C::forged,
                     "Messages that were not sealed with the key that they name; damage, too."),
        base::member("replayed", &C::replayed,
                     "Messages that had come already, and old handshakes."),
        base::member("unsealed", &C::unsealed,
                     "Plain messages, and datagrams that are not Hapnet's."),
        base::member("unknown_key", &C::unknown_key,
                     "Messages sealed with a key that is not known here, for example one of an "
                     "earlier run."),
        base::member("other_circle", &C::other_circle,
                     "Messages of handshakes with other keys, or forged."),
        base::member("refused", &C::refused,
                     "Those that failed when they were read, as a forgery of a member of the "
                     "circle does."),
        base::member("unread", &C::unread,
                     "Messages of handshakes that were not read: repeated, late, or too many at a "
                     "time. A few are normal."),
        base::member("cookies", &C::cookies,
                     "Initiations that were asked for a cookie, as too many came."),
        base::member("roamed", &C::roamed, "How often the other peer was found in another place."),
        base::member("not_sent", &C::not_sealed, "Own messages for which there was no key yet."),
        base::computed<C>(
            "handshake_ms",
            [](const C& counts) {
                const base::Duration took = counts.last_handshake;
                return took > base::Duration{0} ? std::optional{took} : std::nullopt;
            },
            "How long the last handshake took that this side began."));
}

} // namespace hapnet::secure

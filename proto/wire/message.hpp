// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

/// The messages between two peers and their bytes. FORMAT.md in this folder is the
/// specification; this header is its vocabulary.
namespace hapnet::wire {

inline constexpr std::uint8_t protocol_version = 1;

/// Bytes kept free at the end of every message for an authentication tag.
inline constexpr std::size_t tag_bytes = 16;
/// The longest message, the tag's room not counted.
inline constexpr std::size_t message_bytes_max = 144;

/// Answers "when did my message reach you?": the two stamps from which the receiver computes
/// round-trip time and clock offset, as NTP does (RFC 5905).
struct Echo {
    base::TimePoint of;   // `sent` of the newest message from the other side
    base::Duration age{}; // how long before this message it had arrived; at most 4.29 s

    friend bool operator==(const Echo&, const Echo&) = default;
};

/// The name of a task as the hello carries it: at most 16 bytes of printable ASCII.
class TaskName {
public:
    static constexpr std::size_t bytes_max = 16;

    /// nullopt unless 1 to 16 printable ASCII characters without spaces.
    [[nodiscard]] static std::optional<TaskName> from_text(std::string_view text);
    [[nodiscard]] std::string_view text() const;

    friend bool operator==(const TaskName&, const TaskName&) = default;

private:
    std::array<char, bytes_max> characters_{};
};

/// "Here I am, this is what I play; have you heard me?" Sent every 20 ms until both know the
/// start.
struct Hello {
    std::uint32_t nonce = 0;       // this run of the sender; never 0
    std::uint32_t nonce_heard = 0; // the other side's nonce; 0: nothing heard yet
    std::uint16_t peer_id = 0;
    std::uint16_t tick_rate_hz = 0;
    std::uint64_t scene_hash = 0;
    std::uint64_t seed = 0;
    base::TimePoint sent;
    std::optional<Echo> echo;
    std::optional<base::TimePoint> start;       // the session's start on the sender's clock
    std::optional<base::TimePoint> start_heard; // the other side's `start`, as it said it
    bool in_session = false; // the sender was there before: its start and seed count
    TaskName task;

    friend bool operator==(const Hello&, const Hello&) = default;
};

/// A body that a peer moves: its absolute state, and the effects that this peer itself has caused
/// since the session began. The sums are in billionths of a metre and of a newton second; as
/// running sums they survive loss, reordering and duplication.
struct BodyState {
    std::uint16_t body = 0;
    base::Position position;
    base::Velocity velocity;
    std::array<std::int64_t, 3> caused_displacement_nm{};
    std::array<std::int64_t, 3> caused_impulse_nns{};

    friend bool operator==(const BodyState&, const BodyState&) = default;
};

/// One tick of one peer.
struct State {
    std::uint32_t session = 0;
    std::uint32_t sequence = 0; // 1, 2, 3, ... within the session
    base::TimePoint sent;
    std::optional<Echo> echo;
    bool touching = false; // the sender's hand pushes or holds the body
    bool holding = false;  // it holds it
    base::Position hip;
    base::Velocity hip_velocity;
    base::Force contact_force;     // that the sender's hand exerts on the body
    std::optional<BodyState> body; // left out while nothing touches or moves it

    friend bool operator==(const State&, const State&) = default;
};

enum class ByeReason : std::uint8_t {
    finished = 0,
    interrupted = 1,
    other_version = 2,
    other_scene = 3,
    other_task = 4,
    other_tick_rate = 5,
    same_id = 6,
};
inline constexpr std::uint8_t bye_reasons = 7;

/// "I am leaving", or "we cannot play together, and this is why".
struct Bye {
    std::uint32_t session = 0; // 0: there is none
    ByeReason reason = ByeReason::finished;

    friend bool operator==(const Bye&, const Bye&) = default;
};

using Message = std::variant<Hello, State, Bye>;

/// The bytes of one encoded message.
class Datagram {
public:
    [[nodiscard]] std::span<const std::byte> bytes() const { return {bytes_.data(), size_}; }

private:
    friend Datagram encode(const Hello& hello);
    friend Datagram encode(const State& state);
    friend Datagram encode(const Bye& bye);
    template <typename Kind>
    [[nodiscard]] static Datagram of(const Kind& message);

    std::array<std::byte, message_bytes_max> bytes_{};
    std::size_t size_ = 0;
};

/// Ensures what decode() checks: finite vectors, times within 2^60 ns, no zero nonce, echo age in
/// range. Positions,
/// velocities and forces are rounded to single precision (4 nm at 10 cm).
[[nodiscard]] Datagram encode(const Hello& hello);
[[nodiscard]] Datagram encode(const State& state);
[[nodiscard]] Datagram encode(const Bye& bye);
[[nodiscard]] Datagram encode(const Message& message);

/// The message in a datagram. Refuses whatever is not canonical: accepted bytes encode to
/// themselves.
[[nodiscard]] base::Result<Message> decode(std::span<const std::byte> datagram);

/// The protocol version of a datagram that starts like one of ours, whatever follows: the first
/// three bytes are the same in every version.
[[nodiscard]] std::optional<std::uint8_t> version_of(std::span<const std::byte> datagram);

} // namespace hapnet::wire

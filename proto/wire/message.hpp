// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ensure.hpp"
#include "proto/base/result.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

/// The messages between peers and their encoding. docs/formats/wire.md is the specification, and
/// this header uses its terms.
namespace hapnet::wire {

inline constexpr std::uint8_t protocol_version = 2;

/// The largest number of bodies in one state.
inline constexpr std::size_t bodies_max = 8;
/// The length of the longest message: a state with eight bodies that can turn. Each message is one
/// datagram.
inline constexpr std::size_t message_bytes_max = 838;

/// The two stamps from which the receiver computes the round-trip time and the clock offset, as NTP
/// does (RFC 5905). An echo answers the question "when did my message reach you?".
struct Echo {
    base::TimePoint of;   // `sent` of the newest message from the other side
    base::Duration age{}; // time from its arrival until this message; at most 4.29 s

    friend bool operator==(const Echo&, const Echo&) = default;
};

/// The name of a task in a hello: at most 16 characters of printable ASCII.
class TaskName {
public:
    static constexpr std::size_t bytes_max = 16;

    /// Returns nullopt unless the text has 1 to 16 printable ASCII characters without spaces.
    [[nodiscard]] static std::optional<TaskName> from_text(std::string_view text);
    [[nodiscard]] std::string_view text() const;

    friend bool operator==(const TaskName&, const TaskName&) = default;

private:
    std::array<char, bytes_max> characters_{};
};

/// Returns a hash of the text that names a clock, as a boot id does; 0 for an empty text.
[[nodiscard]] std::uint32_t boot_of(std::string_view boot_id);

/// The properties of a hand and its device as the scene sees them, in SI units; 0: not given.
struct HandModel {
    float mass = 0.0F, damping = 0.0F, stiffness = 0.0F, friction = 0.0F;

    friend bool operator==(const HandModel&, const HandModel&) = default;
};

/// "Here I am, this is what I play; have you heard me?" It is sent every 20 ms until both peers
/// know the start.
struct Hello {
    std::uint32_t nonce = 0;       // number of this run of the sender, never 0
    std::uint32_t nonce_heard = 0; // the other side's nonce; 0: nothing heard yet
    std::uint16_t peer_id = 0;     // never 0
    std::uint16_t tick_rate_hz = 0;
    std::uint64_t scene_hash = 0;
    std::uint64_t seed = 0;
    base::TimePoint sent;
    std::optional<Echo> echo;
    std::optional<base::TimePoint> start;       // the session's start on the sender's clock
    std::optional<base::TimePoint> start_heard; // the other side's `start` as received
    bool in_session = false; // the sender was in the session before: its start and seed count
    TaskName task;
    std::uint32_t length_ms = 0; // requested length of the session; 0: not given
    std::uint32_t heard = 0;     // bit i: the sender hears peer i, 1 to 31
    std::uint32_t boot = 0;      // a hash of what names the sender's clock; 0: unknown
    HandModel hand;

    friend bool operator==(const Hello&, const Hello&) = default;
};

/// An orientation in 62 bits: which component of the unit quaternion is the largest, and the other
/// three components in steps of 1.3e-6. The error is at most 4 microradians.
class Orientation {
public:
    Orientation() = default; // not turned
    /// Encodes a quaternion of about unit length. Ensures that its length is close to 1.
    [[nodiscard]] static Orientation from(const glm::dquat& orientation);
    /// Returns nullopt for a code that does not stand for a quaternion.
    [[nodiscard]] static std::optional<Orientation> from_code(std::uint64_t code);

    [[nodiscard]] glm::dquat quaternion() const; // a unit quaternion
    [[nodiscard]] std::uint64_t code() const { return code_; }

    friend bool operator==(const Orientation&, const Orientation&) = default;

private:
    /// The code of the quaternion 1, whose first component is the largest and whose other
    /// components are zero.
    static constexpr std::uint64_t upright =
        std::uint64_t{0x8'0000} << 40 | std::uint64_t{0x8'0000} << 20 | 0x8'0000U;

    explicit Orientation(std::uint64_t code) : code_{code} {}

    std::uint64_t code_ = upright;
};

/// Sums since the session began, modulo 2^32. A receiver subtracts the sums that it read before,
/// with difference(). Running sums tolerate loss, reordering and duplication.
using Sums = std::array<std::uint32_t, 3>;
/// Returns the change between two sums. Its absolute value has to be below 2^31.
[[nodiscard]] constexpr std::array<std::int32_t, 3> difference(const Sums& now, const Sums& before)
{
    std::array<std::int32_t, 3> added{};
    for (std::size_t i = 0; i < 3; ++i) added[i] = static_cast<std::int32_t>(now[i] - before[i]);
    return added;
}

/// The additional state of a body that can turn.
struct Turning {
    Orientation orientation;
    glm::dvec3 angular_velocity{0.0}; // rad/s
    Sums caused_rotation_urad{};
    Sums caused_angular_impulse_unms{}; // millionths of N m s

    friend bool operator==(const Turning&, const Turning&) = default;
};

/// A body that a peer moves: its absolute state, and the effects that this peer itself has caused
/// since the session began.
struct BodyState {
    static constexpr std::uint16_t id_max = 0x7fff;

    std::uint16_t body = 0;
    base::Position position;
    base::Velocity velocity;
    Sums caused_displacement_um{};
    Sums caused_impulse_uns{}; // millionths of N s
    std::optional<Turning> turning;

    friend bool operator==(const BodyState&, const BodyState&) = default;
};

/// The bodies of a state, with ascending ids. The cost of copying depends on the number of bodies.
class BodyStates {
public:
    BodyStates() {} // NOLINT(*-member-init,*-use-equals-default): nothing is made before add()
    BodyStates(const BodyStates& other) : BodyStates{} { *this = other; }
    ~BodyStates() = default;
    BodyStates& operator=(const BodyStates& other);

    /// Adds a body. Ensures that there is room, and that its id is greater than those before it.
    BodyState& add(const BodyState& body)
    {
        return add([&body] { return body; });
    }
    /// Adds the body that make() returns, built in place.
    template <std::invocable Make>
    BodyState& add(Make make)
    {
        base::ensure(count_ < all_.size());
        BodyState& added = *::new (static_cast<void*>(&all_[count_])) BodyState(make());
        base::ensure(count_ == 0 || all_[count_ - 1].body < added.body);
        ++count_;
        return added;
    }
    void clear() { count_ = 0; }

    [[nodiscard]] bool empty() const { return count_ == 0; }
    [[nodiscard]] std::size_t size() const { return count_; }
    [[nodiscard]] const BodyState* begin() const { return all_.data(); }
    [[nodiscard]] const BodyState* end() const { return all_.data() + count_; }
    [[nodiscard]] BodyState* begin() { return all_.data(); }
    [[nodiscard]] BodyState* end() { return all_.data() + count_; }
    /// Returns the first body; nullptr if there is none.
    [[nodiscard]] const BodyState* first() const { return empty() ? nullptr : begin(); }
    /// Returns the state of this body; nullptr if it is not included.
    [[nodiscard]] const BodyState* find(std::uint16_t body) const;

    friend bool operator==(const BodyStates& a, const BodyStates& b);

private:
    static_assert(std::is_trivially_destructible_v<BodyState>);
    union {
        // NOLINTNEXTLINE(readability-identifier-naming): a member of this class
        std::array<BodyState, bodies_max> all_; // only the first count_ are valid
    };
    std::size_t count_ = 0;
};

/// The state of one peer in one tick.
struct State {
    // NOLINTNEXTLINE(*-use-equals-default): without it State{} would clear the room of all bodies
    State() {}

    std::uint32_t session = 0;
    std::uint32_t sequence = 0; // 1, 2, 3, ... within the session
    base::TimePoint sent;
    std::optional<Echo> echo;
    bool touching = false; // the sender's hand pushes or holds the body
    bool holding = false;  // the sender's hand holds the body
    base::Position hip;
    base::Velocity hip_velocity;
    base::Force contact_force; // force of the sender's hand on the bodies
    /// The place where the hand intends to be, relative to the HIP. The resolution is 10 um, the
    /// largest value 0.327 m along an axis.
    base::Displacement intention;
    base::Velocity intention_velocity; // precise to 0.2 mm/s, at most 6.55 m/s per axis
    /// The work that the hand has done on its device since the session began, in microjoules,
    /// modulo 2^32.
    std::uint32_t work_uj = 0;
    BodyStates bodies; // bodies that something touches or moves

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
    std::uint32_t session = 0; // 0: no session
    ByeReason reason = ByeReason::finished;

    friend bool operator==(const Bye&, const Bye&) = default;
};

using Message = std::variant<Hello, State, Bye>;

/// The bytes of one encoded message.
class Datagram { // NOLINT(*-member-init): bytes after the message are never read
public:
    Datagram() = default;                              // NOLINT(*-member-init)
    Datagram(const Datagram& other) { *this = other; } // NOLINT(*-member-init)
    ~Datagram() = default;
    Datagram& operator=(const Datagram& other)
    {
        size_ = other.size_;
        std::memcpy(bytes_.data(), other.bytes_.data(), size_);
        return *this;
    }
    [[nodiscard]] std::span<const std::byte> bytes() const { return {bytes_.data(), size_}; }

private:
    friend Datagram encode(const Hello& hello);
    friend Datagram encode(const State& state);
    friend Datagram encode(const Bye& bye);
    template <typename Kind>
    [[nodiscard]] static Datagram of(const Kind& message);

    std::array<std::byte, message_bytes_max> bytes_;
    std::size_t size_ = 0;
};

/// Returns the number of the session between two runs, computed from their nonces; the nonce of the
/// peer with the lower id is first. It is equal on both sides, different for every pair of runs,
/// and never 0.
[[nodiscard]] std::uint32_t session_number(std::uint32_t low_nonce, std::uint32_t high_nonce);

/// Encodes a message. Ensures what decode() checks: finite vectors, times within 2^60 ns, no zero
/// nonce, an echo age in range. Positions, velocities and forces are rounded to single precision (4
/// nm at 10 cm). An intention that is too far from the HIP is limited to the largest value.
[[nodiscard]] Datagram encode(const Hello& hello);
[[nodiscard]] Datagram encode(const State& state);
[[nodiscard]] Datagram encode(const Bye& bye);
[[nodiscard]] Datagram encode(const Message& message);

/// Decodes the message in a datagram. Refuses all bytes that are not canonical, so accepted bytes
/// encode to themselves.
[[nodiscard]] base::Result<Message> decode(std::span<const std::byte> datagram);

/// Returns the protocol version of a datagram that starts like a message of this protocol. The
/// first three bytes are the same in every version.
[[nodiscard]] std::optional<std::uint8_t> version_of(std::span<const std::byte> datagram);

/// True if the datagram begins like a hello of this version. The other bytes are not checked.
[[nodiscard]] bool is_hello(std::span<const std::byte> datagram);

} // namespace hapnet::wire

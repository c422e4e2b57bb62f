// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/names.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <variant>
#include <vector>

namespace hapnet::record {

/// The phase of a session, as this peer sees it.
enum class Phase : std::uint8_t {
    waiting,   ///< no T0 agreed
    countdown, ///< T0 agreed, not yet come
    running,   ///< from T0 until the hands let go: what the metrics score
    hands_off, ///< the tail in which no hand touches and the copies must agree again
    alone,     ///< the other side has gone; zero force until this side ends
    ended,
};

/// The names of phases in the header of a record and in its CSV.
constexpr auto names_of(base::Tag<Phase> /*enum*/)
{
    return base::names("waiting", "countdown", "running", "hands_off", "alone", "ended");
}
using base::name_of;

/// One tick of the haptic loop. Times are this peer's CLOCK_BOOTTIME, lengths SI.
struct TickRow {
    std::uint64_t tick = 0;
    /// The time when the loop was to wake.
    base::TimePoint due{};
    /// The time from `due` until it woke.
    base::Duration late{};
    /// Ticks skipped between the row before and this one.
    std::uint32_t missed_before = 0;
    /// Sequence of the state message sent in this tick to the first of the others; 1 is the first
    /// of a session, 0: none sent.
    std::uint32_t sent_sequence = 0;
    Phase phase = Phase::waiting;
    bool touching = false;
    bool remote_touching = false;
    /// True if the remote state was young enough to be used.
    bool remote_fresh = false;
    base::Position hip;
    base::Velocity hip_velocity;
    base::Position cube;
    base::Velocity cube_velocity;
    /// The scene's force on the HIP, before the governor.
    base::Force contact;
    /// The force that the device receives, after the governor.
    base::Force device;
    /// The remote contact force as this tick used it.
    base::Force remote;
    /// The rest of the device's sample: the session's forces follow from these and the messages.
    bool gripping = false;
    bool docked = false;
    bool calibrated = true;
    std::uint8_t buttons = 0;
    std::uint8_t fault = 0; // value of device::Fault
    /// Presses of the primary button, counted.
    std::uint16_t presses = 0;
    /// Grows with every report from the device; its lowest bits.
    std::uint16_t sample_sequence = 0;
    /// device::GovernorState after this tick.
    std::uint8_t governor = 0;

    /// The time when the device was read: the row's positions and forces hold at that time.
    [[nodiscard]] base::TimePoint at() const { return due + late; }

    friend bool operator==(const TickRow&, const TickRow&) = default;
};

/// A message as it came from another peer, undecoded.
struct MessageRow {
    /// Length of the longest message: a state with eight bodies that turn.
    static constexpr std::size_t bytes_max = 838;

    /// The tick that read it from the socket.
    std::uint64_t tick = 0;
    /// The kernel's receive stamp.
    base::TimePoint received_at{};
    /// The id of the peer that it came from; 0: not known yet.
    std::uint16_t from = 0;
    std::vector<std::byte> bytes{};

    friend bool operator==(const MessageRow&, const MessageRow&) = default;
};

/// The agreement between this peer and another. Written when the start is agreed, whenever a value
/// changes, and every second.
struct SessionRow {
    /// T0 on this peer's clock.
    base::TimePoint start{};
    base::Duration length{};
    /// The other's clock minus this clock.
    base::Duration remote_offset{};
    /// Bound of the error of `remote_offset`.
    base::Duration offset_uncertainty{};
    std::uint32_t session = 0;
    /// The seed that counts: that of the lowest id.
    std::uint64_t seed = 0;
    /// The id of the other; 0: not said, as in records of version 2.
    std::uint16_t other = 0;
    /// The time, on this clock, at which `remote_offset` held.
    base::TimePoint noted_at{};
    /// The amount by which the other clock runs faster, in parts per million.
    double remote_skew_ppm = 0.0;

    friend bool operator==(const SessionRow&, const SessionRow&) = default;
};

/// Radians per second about the axes of the scene.
using AngularVelocity = base::Vector<struct AngularVelocityKind>;

/// The state of one shared body after a tick. A session that shares several bodies, or a body that
/// can turn, has such a row for each body after each tick. Other sessions have none, as the row of
/// the tick holds their only body.
struct BodyRow {
    /// The tick that the row belongs to.
    std::uint64_t tick = 0;
    /// The number of the body in the scene, as in the messages.
    std::uint16_t body = 0;
    base::Position position{};
    base::Velocity velocity{};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    AngularVelocity angular_velocity{};
    /// The id of the peer whose copy of the body counts, as this peer sees it: its own while its
    /// hand moves the body, that of the lowest other while only others do, and else the owner. 0:
    /// not said, as before a session and in records of version 4.
    std::uint16_t owner = 0;

    friend bool operator==(const BodyRow&, const BodyRow&) = default;
};

using Row = std::variant<TickRow, MessageRow, SessionRow, BodyRow>;

} // namespace hapnet::record

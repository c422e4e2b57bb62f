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
    waiting,   ///< no T0 has been agreed
    countdown, ///< T0 has been agreed and lies ahead
    running,   ///< from T0 until the hands let go; the metrics cover this phase
    hands_off, ///< the final phase without touch, in which the copies must agree again
    alone,     ///< the other side has left; the force is zero until this side ends
    ended,
};

/// The names of phases in the header of a record and in its CSV.
constexpr auto names_of(base::Tag<Phase> /*enum*/)
{
    return base::names("waiting", "countdown", "running", "hands_off", "alone", "ended");
}
using base::name_of;

/// One tick of the haptic loop. Times are on this peer's CLOCK_BOOTTIME, lengths in SI units.
struct TickRow {
    std::uint64_t tick = 0;
    /// The time at which the loop was due to wake.
    base::TimePoint due{};
    /// The delay from `due` until the loop woke.
    base::Duration late{};
    /// The number of ticks skipped between the previous row and this one.
    std::uint32_t missed_before = 0;
    /// The sequence number of the state message that this tick sent to the first of the other
    /// peers. The first of a session is 1; 0: none was sent.
    std::uint32_t sent_sequence = 0;
    Phase phase = Phase::waiting;
    bool touching = false;
    bool remote_touching = false;
    /// True if the remote state was recent enough to be used.
    bool remote_fresh = false;
    base::Position hip;
    base::Velocity hip_velocity;
    base::Position cube;
    base::Velocity cube_velocity;
    /// The force of the scene on the HIP, before the governor.
    base::Force contact;
    /// The force that is sent to the device, after the governor.
    base::Force device;
    /// The remote contact force that this tick used.
    base::Force remote;
    /// The other values of the device's sample. The forces of the session can be computed from them
    /// and the messages.
    bool gripping = false;
    bool docked = false;
    bool calibrated = true;
    std::uint8_t buttons = 0;
    std::uint8_t fault = 0; // value of device::Fault
    /// The number of presses of the primary button so far.
    std::uint16_t presses = 0;
    /// The lowest bits of a number that increases with every report from the device.
    std::uint16_t sample_sequence = 0;
    /// The device::GovernorState after this tick.
    std::uint8_t governor = 0;

    /// Returns the time when the device was read, which is the time of the row's positions and
    /// forces.
    [[nodiscard]] base::TimePoint at() const { return due + late; }

    friend bool operator==(const TickRow&, const TickRow&) = default;
};

/// A message from another peer, undecoded.
struct MessageRow {
    /// The length of the longest message: a state with eight bodies that can turn.
    static constexpr std::size_t bytes_max = 838;

    /// The number of the tick that read the message from the socket.
    std::uint64_t tick = 0;
    /// The kernel's receive stamp.
    base::TimePoint received_at{};
    /// The id of the peer that sent the message; 0: not known yet.
    std::uint16_t from = 0;
    std::vector<std::byte> bytes{};

    friend bool operator==(const MessageRow&, const MessageRow&) = default;
};

/// The agreement between this peer and another. A row is written when the start is agreed, whenever
/// a value changes, and every second.
struct SessionRow {
    /// T0 on this peer's clock.
    base::TimePoint start{};
    base::Duration length{};
    /// The offset of the other peer's clock: its reading minus that of this peer's clock.
    base::Duration remote_offset{};
    /// The bound of the error of `remote_offset`.
    base::Duration offset_uncertainty{};
    std::uint32_t session = 0;
    /// The seed that the session uses: that of the peer with the lowest id.
    std::uint64_t seed = 0;
    /// The id of the other peer; 0: not recorded, as in version 2.
    std::uint16_t other = 0;
    /// The time, on this clock, at which `remote_offset` held.
    base::TimePoint noted_at{};
    /// The rate by which the other clock is faster, in parts per million.
    double remote_skew_ppm = 0.0;

    friend bool operator==(const SessionRow&, const SessionRow&) = default;
};

/// An angular velocity in rad/s about the axes of the scene.
using AngularVelocity = base::Vector<struct AngularVelocityKind>;

/// The state of one shared body after a tick. A session has such a row for each body after each
/// tick if it shares several bodies or a body that can turn. Other sessions have none, as the row
/// of the tick holds their only body.
struct BodyRow {
    /// The number of the tick that the row belongs to.
    std::uint64_t tick = 0;
    /// The number of the body in the scene, which is also used in the messages.
    std::uint16_t body = 0;
    base::Position position{};
    base::Velocity velocity{};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    AngularVelocity angular_velocity{};
    /// The id of the peer whose copy of the body is authoritative, as this peer sees it. This is
    /// the peer itself while its hand moves the body, the lowest of the others while only others
    /// move it, and otherwise the owner. 0: not recorded, as before a session and in records of
    /// version 4.
    std::uint16_t owner = 0;

    friend bool operator==(const BodyRow&, const BodyRow&) = default;
};

using Row = std::variant<TickRow, MessageRow, SessionRow, BodyRow>;

} // namespace hapnet::record

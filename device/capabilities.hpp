// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/space.hpp"

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::device {

/// The note for every device that this software supports only from descriptions.
inline constexpr std::string_view never_run = "never run on the physical device";

/// The identity of a device.
struct Identity {
    std::string backend{}; // as in --device BACKEND:SERIAL
    std::string serial{};  // "": the device has none
    std::string model{};   // such as "PHANToM Omni (FireWire)"
    std::string note{};    // a remark for the user, such as never_run
};

/// The source of the loop's pace.
enum class Pacing : std::uint8_t {
    host,   // the device answers when asked
    device, // the device or its library owns the loop: see Device::pace()
};

/// A kind of arm: the key of its joints' limits in texts, such as "omni_torque_max", and its
/// geometry.
struct Mechanism {
    std::string_view torque_key{};
    /// d position / d joint, m/rad, at a position in the device's frame.
    glm::dmat3 (*jacobian)(const base::Position& position) = nullptr;
};

/// The limits of an arm's joints.
struct JointLimits {
    Mechanism mechanism{};
    glm::dvec3 torque_max_nm{0.0};
};

/// The abilities of a device. Positions are in the device's own frame.
struct Capabilities {
    base::Position workspace_min{{-0.08, -0.06, -0.035}};
    base::Position workspace_max{{0.08, 0.06, 0.035}};
    double force_max_n = 0.0;           // peak, in any direction
    double force_continuous_n = 0.0;    // force that the motors can hold without a time limit
    double stiffness_max_n_per_m = 0.0; // stiffest contact that stays stable; 0: not known
    /// The greatest damping of a contact that stays stable; 0: not known. For information only: it
    /// does not limit scenes.
    double damping_max_ns_per_m = 0.0;
    double resolution_m = 0.0; // smallest step of a position
    double friction_n = 0.0;   // Coulomb friction at the grip; 0: not known
    /// The greatest speed at which a hand moves the device: 1 m/s is far above any task.
    double speed_max_m_per_s = std::numeric_limits<double>::infinity();
    int axes_in = 3;
    int axes_out = 3; // number of axes with motors, from x on
    int buttons = 1;
    bool has_holder = false; // the device knows when its stylus rests in the holder
    bool has_orientation = false;
    bool force_is_calibrated = true; // false: forces in newtons are nominal
    Pacing pacing = Pacing::host;
    double rate_hz = 1000.0;             // nominal
    std::optional<JointLimits> joints{}; // nullopt: not known
};

} // namespace hapnet::device

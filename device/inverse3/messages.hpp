// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "device/polled/exchange.hpp"
#include "proto/base/result.hpp"
#include "proto/base/space.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::device::inverse3 {

// The messages of the vendor's local service, the Inverse Service, as its public reference
// describes them (docs.haply.co, WebSocket Protocol, 3.5): JSON, metres and newtons. The service
// sends one state for each message that it receives. Its frame is right-handed: x right, y away
// from the user, z up.

/// The state of one device in a message of the service, in the device frame of device.hpp.
struct DeviceState {
    std::string id;
    base::Position hip{};
    base::Velocity velocity{};
    bool calibrated = false;
    bool ready = true;      // false: the service does not drive the device (yet)
    bool powered = true;    // false: its motors have no supply
    bool in_use = false;    // another session uses the device
    bool plain_axes = true; // false: the service is configured to permute the axes
};

/// A message of the service.
struct ServiceState {
    std::vector<DeviceState> devices;
    std::uint8_t buttons = 0; // buttons of the first grip: a, b, c from bit 0 on

    /// Returns the device with this identity; nullptr: it does not exist. "": the first device.
    [[nodiscard]] const DeviceState* find(std::string_view id) const;
};

inline constexpr std::size_t message_bytes_max = std::size_t{256} * 1024;
inline constexpr std::size_t devices_max = 16;
inline constexpr std::size_t id_bytes_max = 64;

/// Reads a message. Unknown members are ignored. A device needs an identity of 1 to 64 printable
/// characters without quotes, and a position and a velocity of finite numbers; otherwise the
/// message is an error. A message is also an error if it is not a JSON object, is too long, or has
/// more than 16 devices. A state is calibrated only if it says so.
[[nodiscard]] base::Result<ServiceState> parse_state(std::string_view text);

/// Returns the message that sends the device a force. The device answers it with a state. The force
/// is zero if the motors are off.
[[nodiscard]] std::string force_message(std::string_view id, const polled::Command& command);

/// Returns a device's state as a report. nullptr: the device is no longer listed.
[[nodiscard]] polled::Report report_of(const DeviceState* device, std::uint8_t buttons);

/// Returns the assumed abilities of an Inverse3, as the service does not state them: peak force,
/// continuous force and stiffness of an Omni, within a box around the middle of the arm's reach.
[[nodiscard]] Capabilities capabilities();

} // namespace hapnet::device::inverse3

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "device/fault.hpp"
#include "device/hid/options.hpp"
#include "device/hid/pid_layout.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::device::hid {

/// A HID device as the system presents it.
struct HidNode {
    std::string path{}; // such as "/dev/hidraw0"
    std::uint16_t vendor = 0;
    std::uint16_t product = 0;
    std::string serial{};
    std::string name{};
    std::optional<std::vector<std::byte>> descriptor{};
};

/// A HID device that this software recognised.
struct RecognisedDevice {
    std::string path{};
    std::string node{};   // such as "hidraw0"
    std::string serial{}; // the serial number, or `node` where there is none
    std::string name{};
    bool is_spacemouse = false;
    std::optional<InputLayout> input{}; // nullopt: not a usable PID device
    std::optional<ForceLayout> force{};
    std::string no_force_because{};
    std::optional<DeviceError> unusable{};
};

/// Returns nullopt for a node that is neither a force-feedback device nor a SpaceMouse.
[[nodiscard]] std::optional<RecognisedDevice> recognise(const HidNode& shown);

/// Returns the name and the note for the user.
[[nodiscard]] Identity identity_of(const RecognisedDevice& seen, const Options& options);

} // namespace hapnet::device::hid

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/catalogue/catalogue.hpp"
#include "device/page/page_hand.hpp"
#include "device/replay/hand_trace.hpp"
#include "device/simulated/operator.hpp"
#include "proto/base/space.hpp"
#include "proto/cli/command.hpp"

#include <memory>
#include <optional>
#include <string>

namespace hapnet::peer {

/// The chosen device, and its settings.
struct DeviceChoice {
    std::string name = "sim";
    std::optional<device::HandTrace> replay; // recorded hand for --device replay:FILE
    bool replay_loops = false;
    std::shared_ptr<device::HandWishes> page{}; // requests for the hand of --device page
    device::Operator person;                    // person whose hand moves a simulated device
    device::DeviceOptions options;              // options of a real device
    std::optional<base::Displacement> mount_offset;
    std::optional<double> mount_scale;

    /// True for a simulated device with joints.
    [[nodiscard]] bool has_joints() const { return name == "sim:joints"; }
    [[nodiscard]] bool is_simulated() const { return name == "sim" || has_joints(); }
    /// True if a person holds the device.
    [[nodiscard]] bool is_real() const { return !is_simulated() && !replay && !page; }
};

/// Adds --device and the options that belong to it, bound to `choice`. A wrong value, or an error
/// in a file that an option names, is a usage error and is reported before a device is opened.
/// Returns the option --device.
cli::Option& add_device_options(cli::Command& command, DeviceChoice& choice);

/// Adds only the options that affect a command that lists the real devices.
void add_finding_options(cli::Command& command, device::DeviceOptions& options);

/// Refuses options that belong to a device other than the chosen one. Call it after parsing.
[[nodiscard]] base::Result<void> check_device_options(const cli::Command& command,
                                                      const DeviceChoice& choice);

} // namespace hapnet::peer

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

/// The device that a person wants, and its settings.
struct DeviceChoice {
    std::string name = "sim";
    std::optional<device::HandTrace> replay; // recorded hand for --device replay:FILE
    bool replay_loops = false;
    std::shared_ptr<device::HandWishes> page{}; // wishes for the hand of --device page
    device::Operator person;                    // person whose hand a simulated device has
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
/// in a file that an option names, is bad usage and is found before a device is touched. Returns
/// the option --device.
cli::Option& add_device_options(cli::Command& command, DeviceChoice& choice);

/// Adds only those of these options that matter to a command which lists the real devices.
void add_finding_options(cli::Command& command, device::DeviceOptions& options);

/// Refuses options of another device than the chosen one. Call it after the command line was read.
[[nodiscard]] base::Result<void> check_device_options(const cli::Command& command,
                                                      const DeviceChoice& choice);

} // namespace hapnet::peer

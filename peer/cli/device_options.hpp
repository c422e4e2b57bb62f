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

/// Which device a person wants, and how.
struct DeviceChoice {
    std::string name = "sim";
    std::optional<device::HandTrace> replay; // where it is replay:FILE
    bool replay_loops = false;
    std::shared_ptr<device::HandWishes> page{}; // where it is page: what it is told
    device::Operator person;                    // whose hand is simulated, where it is sim
    device::DeviceOptions options;              // where it is real
    std::optional<base::Displacement> mount_offset;
    std::optional<double> mount_scale;

    [[nodiscard]] bool has_joints() const { return name == "sim:joints"; } // simulated ones
    [[nodiscard]] bool is_simulated() const { return name == "sim" || has_joints(); }
    /// A person holds it.
    [[nodiscard]] bool is_real() const { return !is_simulated() && !replay && !page; }
};

/// Adds --device and what belongs to it, bound to `choice`. What is wrong with one of them, or with
/// a file that it names, is bad usage and found before a device is touched. Gives --device.
cli::Option& add_device_options(cli::Command& command, DeviceChoice& choice);

/// Of these, what matters to a command that only lists the real devices.
void add_finding_options(cli::Command& command, device::DeviceOptions& options);

/// After the command line was read: an option of another device than the chosen one is refused.
[[nodiscard]] base::Result<void> check_device_options(const cli::Command& command,
                                                      const DeviceChoice& choice);

} // namespace hapnet::peer

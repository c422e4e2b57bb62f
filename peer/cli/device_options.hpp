// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/catalogue/catalogue.hpp"
#include "device/replay/hand_trace.hpp"
#include "device/simulated/operator.hpp"
#include "peer/cli/taker.hpp"
#include "proto/base/space.hpp"

#include <CLI/App.hpp>
#include <optional>
#include <string>

namespace hapnet::peer {

/// Which device a person wants, and how.
struct DeviceChoice {
    std::string name = "sim";
    std::optional<device::HandTrace> replay; // where it is replay:FILE
    bool replay_loops = false;
    device::Operator person;       // whose hand is simulated, where it is sim
    device::DeviceOptions options; // where it is real
    std::optional<base::Displacement> mount_offset;
    std::optional<double> mount_scale;

    [[nodiscard]] bool has_joints() const { return name == "sim:joints"; } // simulated ones
    [[nodiscard]] bool is_simulated() const { return name == "sim" || has_joints(); }
    /// A person holds it.
    [[nodiscard]] bool is_real() const { return !is_simulated() && !replay; }
};

/// The words of it on a command line; nullopt or false where nothing is said.
struct DeviceTexts {
    std::string device = "sim";
    std::optional<std::string> person;
    bool replay_loops = false;
    std::optional<std::string> hd_library;
    std::optional<std::string> falcon_firmware;
    bool uncalibrated_force = false;
    std::optional<std::string> omni_torque;
    std::optional<std::string> hid_force;
    std::optional<std::string> hid_travel;
    std::optional<std::string> mount_offset;
    std::optional<std::string> mount_scale;
};

/// Adds --device and what belongs to it.
void add_device_options(CLI::App& app, DeviceTexts& texts);
/// Of these, what matters to who only looks at the real devices that there are.
void add_finding_options(CLI::App& app, DeviceTexts& texts);

/// Reads them, and the files that they name: what is wrong with one is bad usage, found before a
/// device is touched. So is an option of another device than the one that is chosen.
void take_device(DeviceChoice& choice, Taker& taker, const DeviceTexts& texts);
/// Of these, what add_finding_options() added.
void take_finding(device::DeviceOptions& options, Taker& taker, const DeviceTexts& texts);

} // namespace hapnet::peer

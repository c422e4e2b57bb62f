// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/catalogue/catalogue.hpp"
#include "device/replay/hand_trace.hpp"
#include "device/simulated/operator.hpp"
#include "peer/taker.hpp"
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

/// The words of it on a command line.
struct DeviceTexts {
    std::string device = "sim";
    std::string person = "nominal";
    bool replay_loops = false;
    device::DeviceOptions options;
    std::optional<std::string> hid_force;
    std::optional<std::string> hid_travel;
    std::optional<std::string> mount_offset;
    std::optional<std::string> mount_scale;
};

/// Adds --device and what belongs to it.
void add_device_options(CLI::App& app, DeviceTexts& texts);
/// Of these, what the backends of real devices ask for.
void add_backend_options(CLI::App& app, DeviceTexts& texts);

/// Reads them, and the files that they name.
void take_device(DeviceChoice& choice, Taker& taker, const DeviceTexts& texts);

} // namespace hapnet::peer

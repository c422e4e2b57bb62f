// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "device/mount.hpp"
#include "device/simulated/task.hpp"
#include "peer/cli/device_options.hpp"
#include "peer/device_state/kept_device.hpp"

#include <memory>
#include <optional>
#include <string>

namespace hapnet::peer {

/// Opens the device. `task` is the task of a simulated hand.
[[nodiscard]] device::Opened<std::unique_ptr<device::Device>>
open_chosen(const DeviceChoice& choice, device::Task task);

/// Returns why the device was not opened, and what to do.
[[nodiscard]] std::string describe_open_error(const DeviceChoice& choice,
                                              const device::DeviceError& error);

/// Returns the state of the device that is kept after the program ends; nullopt for a device that
/// is not real or has no motors.
[[nodiscard]] std::optional<device_state::KeptDevice> kept_of(const DeviceChoice& choice,
                                                              const device::Device& device);

/// Returns the mount of the device in the scene, as given by --mount-scale and --mount-offset. By
/// default, the positions of a simulated or replayed hand are used unchanged. Those of a real
/// device are magnified, never shrunk, until it covers the workspace of an Omni on each of its axes
/// (160 x 120 x 70 mm). The centre of its workspace is placed at the origin, where the paper's cube
/// starts.
[[nodiscard]] device::Mount mount_of(const DeviceChoice& choice,
                                     const device::Capabilities& capabilities);

/// Returns a note if the contacts of the scene, measured at the hand, are stiffer than the device
/// can render. It has both figures and the remedy. Returns "" if the device renders them fully or
/// has no motors.
[[nodiscard]] std::string note_on_stiffness(const device::Capabilities& capabilities,
                                            const device::Mount& mount,
                                            double scene_stiffness_n_per_m);

/// Returns a note that gives the effective limit if --force-limit is above what the device allows;
/// otherwise "".
[[nodiscard]] std::string note_on_force_limit(double asked_n, double allowed_n);

/// Returns a description of each side's part in a task, for a person at a real device.
[[nodiscard]] std::string_view parts_in(device::Task task);

/// Returns a description of the device, of its mount, and of the part of the person who holds it.
[[nodiscard]] std::string introduction(const device::Device& device, const device::Mount& mount,
                                       device::Task task);

} // namespace hapnet::peer

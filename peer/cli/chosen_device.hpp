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

/// Opens the device. The task is for a simulated hand.
[[nodiscard]] device::Opened<std::unique_ptr<device::Device>>
open_chosen(const DeviceChoice& choice, device::Task task);

/// Why the device was not opened, and what to do.
[[nodiscard]] std::string describe_open_error(const DeviceChoice& choice,
                                              const device::DeviceError& error);

/// Returns the state of the device that is kept after the program ends; nullopt for a device that
/// is not real or has no motors.
[[nodiscard]] std::optional<device_state::KeptDevice> kept_of(const DeviceChoice& choice,
                                                              const device::Device& device);

/// Returns the device's place in the scene, as --mount-scale and --mount-offset say. Without them a
/// simulated or replayed hand is in the scene already. A real device is then magnified, never
/// shrunk, until it covers on each of its axes what an Omni does (160 x 120 x 70 mm), and the
/// centre of its workspace is put to the origin, where the paper's cube starts.
[[nodiscard]] device::Mount mount_of(const DeviceChoice& choice,
                                     const device::Capabilities& capabilities);

/// A note for a scene whose contacts are stiffer at the hand than the device renders: both figures
/// and the remedy. "" when the device renders them fully or has no motors.
[[nodiscard]] std::string note_on_stiffness(const device::Capabilities& capabilities,
                                            const device::Mount& mount,
                                            double scene_stiffness_n_per_m);

/// A note for a --force-limit above what the device allows: which limit holds. "" for others.
[[nodiscard]] std::string note_on_force_limit(double asked_n, double allowed_n);

/// Describes the part of each side in a task, for a person at a real device.
[[nodiscard]] std::string_view parts_in(device::Task task);

/// The device, its mount, and the part of the person who holds it.
[[nodiscard]] std::string introduction(const device::Device& device, const device::Mount& mount,
                                       device::Task task);

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "device/mount.hpp"
#include "device/simulated/task.hpp"
#include "peer/cli/device_options.hpp"

#include <memory>
#include <string>

namespace hapnet::peer {

/// Takes hold of the device. The task is that of a simulated hand.
[[nodiscard]] device::Opened<std::unique_ptr<device::Device>>
open_chosen(const DeviceChoice& choice, device::Task task);

/// Why it was not opened, and what to do; of a real device also that its backend never met it.
[[nodiscard]] std::string why_not_opened(const DeviceChoice& choice,
                                         const device::Trouble& trouble);

/// Where the device stands in the scene. What is said counts; for the rest a simulated or replayed
/// hand is in the scene already, and a real device is magnified so far that on each of its axes it
/// covers what an Omni does (160 x 120 x 70 mm), never shrunk, and the centre of its workspace is
/// the origin, where the paper's cube starts.
[[nodiscard]] device::Mount mount_of(const DeviceChoice& choice,
                                     const device::Capabilities& capabilities);

/// What the contacts of a scene come to at the hand, and how much of them the device renders: both
/// figures and the cure, where it is not all; "" where it is, or where there is no force.
[[nodiscard]] std::string words_on_stiffness(const device::Capabilities& capabilities,
                                             const device::Mount& mount,
                                             double scene_stiffness_n_per_m);

/// What the persons on either side do in a task: for who holds a real device.
[[nodiscard]] std::string_view parts_in(device::Task task);

/// Who the device is, where it is mounted, and what its person is to do: a few lines.
[[nodiscard]] std::string introduction(const device::Device& device, const device::Mount& mount,
                                       device::Task task);

} // namespace hapnet::peer

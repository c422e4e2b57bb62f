// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/fault.hpp"
#include "device/hid/options.hpp"

#include <memory>
#include <string>
#include <vector>

namespace hapnet::device::hid {

/// Returns the force-feedback devices (USB HID PID) and the SpaceMouses that the kernel shows as
/// hidraw nodes, with or without permission to use them, and no other HID devices. If a device has
/// no serial number, the name of the node replaces it, such as "hidraw0".
[[nodiscard]] std::vector<Found> find_hids(const Options& options);

/// Opens the device with this serial number or node name; "": the first usable device. Without
/// options.force_full_n a PID device is only read, and its note says so.
[[nodiscard]] Opened<std::unique_ptr<Device>> open_hid(const std::string& serial,
                                                       const Options& options);

} // namespace hapnet::device::hid

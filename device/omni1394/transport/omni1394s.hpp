// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"

#include <memory>
#include <string>
#include <vector>

namespace hapnet::device::omni1394 {

/// Options of the FireWire Omnis.
struct Options {
    std::string profile{};           // file in the format of device/omni1394/drive.hpp; "": none
    bool uncalibrated_force = false; // up to a quarter of full scale without measured torques
};

/// Finds all Omnis on the computer's buses. The serial is the one printed on the device. If the
/// device cannot be asked for it, the serial is that of its bus interface, "0x000b99...".
[[nodiscard]] std::vector<Found> find_omnis();

/// Opens the Omni with this serial (either of the two serials), or with "" the first usable Omni.
[[nodiscard]] Opened<std::unique_ptr<Device>> open_omni(const std::string& serial,
                                                        const Options& options);

} // namespace hapnet::device::omni1394

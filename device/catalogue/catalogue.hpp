// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::device {

/// What a person may have to say of a device besides its name. Files are paths.
struct DeviceOptions {
    std::string hd_library{};            // hdapi: the vendor's library; "": by its usual names
    std::string falcon_firmware{};       // falcon: "": it has to be running already
    std::string omni_torque{};           // omni1394: measured torque per count; "": none
    bool uncalibrated_force = false;     // omni1394: force without such a table, at most a quarter
    std::optional<double> hid_force_n{}; // hid: what full scale is at the grip; without: no force
};

/// Every device of every backend that can be seen without taking hold of it.
[[nodiscard]] std::vector<Found> find_devices(const DeviceOptions& options);

/// Opens BACKEND or BACKEND:SERIAL, of those that are real: omni1394, hdapi, falcon, hid. Without a
/// serial the first that is usable.
[[nodiscard]] Opened<std::unique_ptr<Device>> open_device(const std::string& name,
                                                          const DeviceOptions& options);

} // namespace hapnet::device

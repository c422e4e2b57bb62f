// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "proto/base/result.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::device {

/// The options of a device, in addition to its name. Files are paths.
struct DeviceOptions {
    std::string hd_library{};            // hdapi: vendor's library; "": found by its usual names
    std::string dhd_library{};           // dhd: vendor's library; "": found by its usual names
    std::uint16_t inverse3_port = 10001; // inverse3: port of the vendor's service on this machine
    std::string falcon_firmware{};       // falcon: firmware file; "": must be running already
    std::string omni_torque{};           // omni1394: file with the torque per count; "": none
    bool uncalibrated_force = false;     // omni1394: force without measured torque, at most 1/4
    std::optional<double> hid_force_n{}; // hid: full-scale force at the grip; nullopt: none
    double hid_travel_m = 0.16;          // hid: travel of the grip between the stops of an axis
};

/// A kind of real device, with the functions that find and open such devices.
struct Backend {
    std::string_view name; // as in --device NAME:SERIAL
    std::string_view what; // description of the devices
    /// Returns all devices of this kind that can be found without opening one.
    std::vector<Found> (*find)(const DeviceOptions& options);
    /// Opens the device with this serial; "": the first usable one.
    Opened<std::unique_ptr<Device>> (*open)(const std::string& serial,
                                            const DeviceOptions& options);
};

/// The backends of real devices that this build has.
[[nodiscard]] const std::vector<Backend>& backends();

/// The name of a real device as --device takes it, such as {"falcon", "12345"}.
struct DeviceName {
    std::string backend;
    std::string serial; // "": any device of this backend
};

/// Reads BACKEND or BACKEND:SERIAL. The backend must exist.
[[nodiscard]] base::Result<DeviceName> parse_device_name(std::string_view text);

/// Returns every device of every backend that can be seen without opening it.
[[nodiscard]] std::vector<Found> find_devices(const DeviceOptions& options);

/// Opens BACKEND or BACKEND:SERIAL. Without a serial it opens the first usable device.
[[nodiscard]] Opened<std::unique_ptr<Device>> open_device(const std::string& name,
                                                          const DeviceOptions& options);

} // namespace hapnet::device

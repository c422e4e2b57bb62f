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

/// Options of a device besides its name. Files are paths.
struct DeviceOptions {
    std::string hd_library{};            // hdapi: the vendor's library; "": by its usual names
    std::string dhd_library{};           // dhd: likewise
    std::uint16_t inverse3_port = 10001; // inverse3: of its service, on this machine
    std::string falcon_firmware{};       // falcon: "": it has to be running already
    std::string omni_torque{};           // omni1394: measured torque per count; "": none
    bool uncalibrated_force = false;     // omni1394: force without such a table, at most a quarter
    std::optional<double> hid_force_n{}; // hid: of full scale at the grip; without: no force
    double hid_travel_m = 0.16;          // hid: of the grip, from stop to stop of an axis
};

/// A kind of real device, and the way to its devices.
struct Backend {
    std::string_view name; // as in --device NAME:SERIAL
    std::string_view what; // it is for
    /// Returns all devices of this kind that can be found without opening one.
    std::vector<Found> (*find)(const DeviceOptions& options);
    /// The one with this serial; "": the first that is usable.
    Opened<std::unique_ptr<Device>> (*open)(const std::string& serial,
                                            const DeviceOptions& options);
};

/// The backends of real devices that this build has.
[[nodiscard]] const std::vector<Backend>& backends();

/// The name of a real device as --device takes it, such as {"falcon", "12345"}.
struct DeviceName {
    std::string backend;
    std::string serial; // "": any
};

/// Reads BACKEND or BACKEND:SERIAL, of the backends that there are.
[[nodiscard]] base::Result<DeviceName> parse_device_name(std::string_view text);

/// Every device of every backend that can be seen without opening it.
[[nodiscard]] std::vector<Found> find_devices(const DeviceOptions& options);

/// Opens BACKEND or BACKEND:SERIAL. Without a serial the first that is usable.
[[nodiscard]] Opened<std::unique_ptr<Device>> open_device(const std::string& name,
                                                          const DeviceOptions& options);

} // namespace hapnet::device

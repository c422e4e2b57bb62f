// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"

#include <memory>
#include <string>
#include <vector>

namespace hapnet::device::dhd {

/// Returns the devices of Force Dimension on the USB. The library is loaded to test whether it can
/// be loaded, but no device is opened.
[[nodiscard]] std::vector<Found> find_dhds(const std::string& library);

/// Opens the device with this serial number; "": the first one.
[[nodiscard]] Opened<std::unique_ptr<Device>> open_dhd(const std::string& serial,
                                                       const std::string& library);

} // namespace hapnet::device::dhd

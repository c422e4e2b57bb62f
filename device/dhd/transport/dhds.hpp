// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"

#include <memory>
#include <string>
#include <vector>

namespace hapnet::device::dhd {

/// Devices of Force Dimension on the USB. The library is loaded to see whether it can be, but no
/// device is touched.
[[nodiscard]] std::vector<Found> find_dhds(const std::string& library);

/// Opens the device with this serial number; "": the first one.
[[nodiscard]] Opened<std::unique_ptr<Device>> open_dhd(const std::string& serial,
                                                       const std::string& library);

} // namespace hapnet::device::dhd

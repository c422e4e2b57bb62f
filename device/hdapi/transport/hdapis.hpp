// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"

#include <memory>
#include <string>
#include <vector>

namespace hapnet::device::hdapi {

/// Returns the names in the vendor's configuration, and devices on the USB that need its library.
/// The library is loaded to test whether it can be loaded, but no device is opened.
[[nodiscard]] std::vector<Found> find_hdapis(const std::string& library);

/// Opens the device of this name; "": the default device, under one of its usual names.
[[nodiscard]] Opened<std::unique_ptr<Device>> open_hdapi(const std::string& name,
                                                         const std::string& library);

/// Opens several devices at once, all or none. They share the library's one scheduler, so that one
/// process can own them. It is not known whether two processes can each own one.
[[nodiscard]] Opened<std::vector<std::unique_ptr<Device>>>
open_hdapis(const std::vector<std::string>& names, const std::string& library);

} // namespace hapnet::device::hdapi

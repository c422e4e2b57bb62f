// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace hapnet::device::hdapi {

/// The names that the vendor's set-up has given to devices of this user: its files NAME.config.
[[nodiscard]] std::vector<std::string> configured_names();

/// Devices on the USB that only the vendor's library can drive, by what public udev rules call
/// them.
[[nodiscard]] std::vector<std::string> models_on_usb();

} // namespace hapnet::device::hdapi

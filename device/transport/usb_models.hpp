// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/usb_ids.hpp"

#include <string>
#include <vector>

namespace hapnet::device {

/// Returns the devices of this kind on the USB, with the names from public lists: "Touch (USB
/// 2988:0304)". For devices that only their vendor's library or service can open.
[[nodiscard]] std::vector<std::string> models_on_usb(UsbKind kind);

} // namespace hapnet::device

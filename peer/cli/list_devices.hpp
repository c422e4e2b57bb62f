// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"

#include <string>
#include <vector>

namespace hapnet::peer {

/// Returns a table for people, with advice on devices that cannot be used.
[[nodiscard]] std::string device_table(const std::vector<device::Found>& found);

/// Returns the list as one JSON object.
[[nodiscard]] std::string device_json(const std::vector<device::Found>& found);

} // namespace hapnet::peer

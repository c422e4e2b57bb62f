// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"

#include <string>
#include <vector>

namespace hapnet::peer {

/// A table for a person, with what to do about those that cannot be used.
[[nodiscard]] std::string device_table(const std::vector<device::Found>& found);

/// The list as one JSON object.
[[nodiscard]] std::string device_json(const std::vector<device::Found>& found);

} // namespace hapnet::peer

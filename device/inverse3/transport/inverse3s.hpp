// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace hapnet::device::inverse3 {

/// Returns the devices that the service on this port of this machine lists after a connection. No
/// command is sent. Returns none if no program listens there, or a program other than the service.
[[nodiscard]] std::vector<Found> find_inverse3s(std::uint16_t port);

/// Opens the device with this identity; "": the first one.
[[nodiscard]] Opened<std::unique_ptr<Device>> open_inverse3(const std::string& id,
                                                            std::uint16_t port);

} // namespace hapnet::device::inverse3

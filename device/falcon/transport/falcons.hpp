// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"

#include <memory>
#include <string>
#include <vector>

namespace hapnet::device::falcon {

/// The Falcons on this computer's USB ports. One without a serial number, or whose number may not
/// be read, is called by its port, such as "usb-1-2". The state of their firmware is known only
/// after they are opened.
[[nodiscard]] std::vector<Found> find_falcons();

/// Opens the one with this serial or port, or, by "", the first that is usable, and waits until its
/// firmware runs: under a second where it does already, up to some tens of seconds where it has to
/// be loaded, which is tried 5 times. `firmware_file`: Novint's; "": none.
[[nodiscard]] Opened<std::unique_ptr<Device>> open_falcon(const std::string& serial,
                                                          const std::string& firmware_file);

} // namespace hapnet::device::falcon

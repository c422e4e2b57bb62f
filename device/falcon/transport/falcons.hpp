// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"

#include <memory>
#include <string>
#include <vector>

namespace hapnet::device::falcon {

/// Returns the Falcons on this computer's USB ports. A Falcon without a serial number, or whose
/// number may not be read, is named by its port, such as "usb-1-2". The state of its firmware is
/// known only after it is opened.
[[nodiscard]] std::vector<Found> find_falcons();

/// Opens the Falcon with this serial or port, or with "" the first usable one, and waits until its
/// firmware runs. That takes less than a second if it runs already, and up to some tens of seconds
/// if it has to be loaded, which is tried 5 times. `firmware_file`: a file of Novint; "": none.
[[nodiscard]] Opened<std::unique_ptr<Device>> open_falcon(const std::string& serial,
                                                          const std::string& firmware_file);

} // namespace hapnet::device::falcon

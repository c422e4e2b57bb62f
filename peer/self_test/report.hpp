// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "peer/self_test/step.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::peer::self_test {

/// For a person.
[[nodiscard]] std::string report_text(const std::string& device,
                                      const std::vector<Outcome>& outcomes);
/// What docs/HARDWARE.md asks a person to send.
[[nodiscard]] nlohmann::json report_json(const device::Device& device,
                                         const std::vector<Outcome>& outcomes);
[[nodiscard]] bool has_failed(const std::vector<Outcome>& outcomes);

} // namespace hapnet::peer::self_test

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "peer/self_test/self_test.hpp"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::peer::self_test {

/// For a person.
[[nodiscard]] std::string report_text(const device::Device& device, const SelfTest& test);
/// What docs/use/hardware.md asks a person to send.
[[nodiscard]] nlohmann::json report_json(const device::Device& device, const SelfTest& test);
/// The test came to its end, and no step failed.
[[nodiscard]] bool has_passed(const SelfTest& test);
/// Whether its step with force was done and passed.
[[nodiscard]] bool has_shown_force(const SelfTest& test);

} // namespace hapnet::peer::self_test

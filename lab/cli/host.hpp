// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

namespace hapnet::lab {

/// Describes the machine that the program runs on, for manifests.
[[nodiscard]] nlohmann::ordered_json host();

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

namespace hapnet::lab {

/// The machine that we run on, for manifests.
[[nodiscard]] nlohmann::ordered_json host();

} // namespace hapnet::lab

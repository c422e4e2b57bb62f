// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/peer.hpp"
#include "proto/base/result.hpp"

#include <nlohmann/json.hpp>

namespace hapnet::lab {

/// With what a peer was made whose record has this configuration. The error names the key.
[[nodiscard]] base::Result<peer::Settings> settings_of(const nlohmann::json& config);

} // namespace hapnet::lab

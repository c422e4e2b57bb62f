// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/secure/primitives.hpp"

namespace hapnet::secure::keys {

/// Draws a secret from the system's source of randomness. No other function draws one. Calls
/// prepare().
[[nodiscard]] Secret draw();

} // namespace hapnet::secure::keys

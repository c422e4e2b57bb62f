// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/secure/primitives.hpp"

namespace hapnet::secure::keys {

/// A secret from the system's source of randomness: the only place that draws one. Calls prepare().
[[nodiscard]] Secret draw();

} // namespace hapnet::secure::keys

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/base_algorithm.hpp"
#include "proto/base/result.hpp"

#include <string_view>
#include <variant>

namespace hapnet::peer {

/// How two copies of the shared body are kept together: a closed set, chosen by name. To add one,
/// write a value with BaseAlgorithm's tick() and name it here.
using Algorithm = std::variant<BaseAlgorithm>;

/// "base"
[[nodiscard]] base::Result<Algorithm> algorithm_named(std::string_view name);

} // namespace hapnet::peer

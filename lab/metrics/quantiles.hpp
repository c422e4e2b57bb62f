// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <optional>
#include <vector>

namespace hapnet::lab::metrics {

/// Exact quantiles by nearest rank: each is one of the values.
struct Quantiles {
    base::Duration p50{};
    base::Duration p99{};
    base::Duration max{};

    friend bool operator==(const Quantiles&, const Quantiles&) = default;
};

/// nullopt when there are no values.
[[nodiscard]] std::optional<Quantiles> quantiles_of(std::vector<base::Duration> values);

} // namespace hapnet::lab::metrics

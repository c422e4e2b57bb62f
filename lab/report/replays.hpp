// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/results/results.hpp"
#include "proto/page/blocks.hpp"

namespace hapnet::lab::report {

/// Returns the replays in the form for the player: columns of 16 bits per value.
[[nodiscard]] page::Json replays_of(const results::Results& results);

} // namespace hapnet::lab::report

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/profile/reading.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// The role of a text among the two delays of a direction: "5ms" is 5 ms as a delay, and from -5 ms
/// to 5 ms as a jitter.
enum class Role { delay, jitter };

/// Reads "160ms", "none" or { law = ..., ..., correlation_time = ... }. The order of departure of
/// the table, if there is one, is stored in `order`.
[[nodiscard]] Variation read_variation(const Node& node, Role role, std::optional<Order>& order,
                                       Reading& reading);
[[nodiscard]] std::string variation_text(const Variation& variation, Role role);

/// Reads "93%", "40/100", "none", { law = ... } or a list of them.
[[nodiscard]] std::vector<LossLaw> read_losses(const Node& node, Reading& reading);
[[nodiscard]] std::string losses_text(const std::vector<LossLaw>& laws);

/// Reads "40/100": lost / of. Reports an error for any other text. A value of 0 lost is left to the
/// check of the law.
[[nodiscard]] Burst read_burst(const Node& node, Reading& reading);

/// Reads "keep", "free" or "sorted".
[[nodiscard]] Order read_order(const Node& node, Reading& reading);

} // namespace hapnet::emulator

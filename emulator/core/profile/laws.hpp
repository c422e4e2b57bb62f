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

/// "160ms", "none" or { law = ..., ..., correlation_time = ... }. The table's order of departure,
/// if it has one, is put into `order`.
[[nodiscard]] Variation read_variation(const Node& node, Role role, std::optional<Order>& order,
                                       Reading& reading);
[[nodiscard]] std::string variation_text(const Variation& variation, Role role);

/// "93%", "40/100", "none", { law = ... } or a list of them.
[[nodiscard]] std::vector<LossLaw> read_losses(const Node& node, Reading& reading);
[[nodiscard]] std::string losses_text(const std::vector<LossLaw>& laws);

/// "40/100": lost / of. Complains of anything else; 0 lost is a fault of the law.
[[nodiscard]] Burst read_burst(const Node& node, Reading& reading);

/// "keep", "free" or "sorted".
[[nodiscard]] Order read_order(const Node& node, Reading& reading);

} // namespace hapnet::emulator

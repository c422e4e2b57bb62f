// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"

#include <optional>
#include <string>

namespace hapnet::emulator {

// What is impossible about something that a profile says, in words that say what would be right;
// nullopt: it is possible.

[[nodiscard]] std::optional<std::string> fault_of(const Variation& variation);
[[nodiscard]] std::optional<std::string> fault_of(const LossLaw& law);
[[nodiscard]] std::optional<std::string> fault_of(const Corruption& corruption);
[[nodiscard]] std::optional<std::string> fault_of(const Duplication& duplication);
[[nodiscard]] std::optional<std::string> fault_of(const Reordering& reordering);
[[nodiscard]] std::optional<std::string> fault_of(const Mtu& mtu);
[[nodiscard]] std::optional<std::string> fault_of(const Rate& rate);

} // namespace hapnet::emulator

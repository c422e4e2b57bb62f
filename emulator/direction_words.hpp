// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/direction_report.hpp"

#include <string>
#include <string_view>

namespace hapnet::emulator {

/// Returns a line about a direction for a person.
[[nodiscard]] std::string in_words(std::string_view title, const DirectionReport& report);

/// Returns the part of a terminal's status line that is about a direction.
[[nodiscard]] std::string in_short(std::string_view title, const DirectionReport& report);

} // namespace hapnet::emulator

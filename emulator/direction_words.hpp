// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/direction_report.hpp"

#include <string>
#include <string_view>

namespace hapnet::emulator {

/// A line for a person.
[[nodiscard]] std::string in_words(std::string_view title, const DirectionReport& report);

/// A part of a line on a terminal.
[[nodiscard]] std::string in_short(std::string_view title, const DirectionReport& report);

} // namespace hapnet::emulator

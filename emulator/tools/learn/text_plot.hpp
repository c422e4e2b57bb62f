// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/tools/learn/delays.hpp"
#include "emulator/tools/learn/losses.hpp"

#include <string>

namespace hapnet::emulator::tools {

// Plots of measured values and a law, as text of at most 78 columns: '#' is measured, '|' is the
// law.

/// Returns a histogram of the delays between their 0.5 and 99.5 % quantiles, in 16 classes.
[[nodiscard]] std::string delay_plot(const MeasuredWay& way, const DelayModel& model);

/// Returns the number of runs of losses of each length. Lengths of 8 and more share a line.
[[nodiscard]] std::string loss_plot(const MeasuredWay& way, const LossModel& model);

} // namespace hapnet::emulator::tools

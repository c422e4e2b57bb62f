// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

namespace hapnet::lab::metrics {

/// Returns the greatest energy, in joules, that all hands together have got out of their devices
/// beyond the energy that they had put in until then: max(0, -min E), where E is the running sum of
/// all hands' work, from 0. The system between the devices has created this energy; a passive
/// system creates none. The energy stored in springs counts as put in. A single device may give out
/// energy that another hand put in elsewhere. nullopt when there is no sample.
[[nodiscard]] std::optional<double>
energy_taken_of(std::span<const std::span<const double>> work_of_hands);

} // namespace hapnet::lab::metrics

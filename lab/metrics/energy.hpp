// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

namespace hapnet::lab::metrics {

/// The most energy, in joules, that all hands have together got out of their devices beyond what
/// they had put in until then: max(0, -min E), E the running sum of the work of all, from 0. The
/// system between the devices has created this energy; a passive system creates none. The energy
/// stored in springs counts as put in. One device alone may well give what another hand put in
/// elsewhere. nullopt when there is no sample.
[[nodiscard]] std::optional<double>
energy_taken_of(std::span<const std::span<const double>> work_of_hands);

} // namespace hapnet::lab::metrics

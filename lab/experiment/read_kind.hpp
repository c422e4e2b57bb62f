// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"
#include "proto/base/reading.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace hapnet::lab::experiment {

inline constexpr std::uint32_t seeds_max = 1000;
inline constexpr std::uint32_t first_seed_max = 1'000'000'000;

// The values of an experiment's keys. What is wrong is complained of.

/// A whole number from 1 to `most`; what is not there (nullptr) leaves the target as it was.
void read_positive(const base::Node* node, std::uint32_t& target, std::uint32_t most,
                   base::Reading& reading);

/// A list of different texts, at least one; or one text alone.
[[nodiscard]] std::vector<std::string> read_texts(const base::Node& node, base::Reading& reading);
[[nodiscard]] std::vector<device::Task> read_tasks(const base::Node& node, base::Reading& reading);

/// One operator for both, or a list of two: L and R.
void read_hands(const base::Node& node, Hands& target, base::Reading& reading);

/// What a kind of experiment says besides what all say.
void read_kind(const base::Node& name, base::TableReader& table, Kind& target);

} // namespace hapnet::lab::experiment

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/text.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/result.hpp"

#include <map>
#include <string>

namespace hapnet::lab {

/// plan.json: an experiment with all its inputs, so that each shard of it, on any machine, plays
/// sessions of the same experiment.
struct Plan {
    std::string experiment; // the EXPERIMENT given to `hapnet-lab plan`
    experiment::Overrides overrides{};
    std::string criteria;                       // the value of its --criteria
    std::map<std::string, std::string> files{}; // the texts of all files that were read, by name
    std::string program; // program that made the plan: another one may play differently
};

inline constexpr const char* plan_name = "plan.json";

/// The file of the plan that a word names: itself, or in the folder; empty: it names no plan.
[[nodiscard]] std::string plan_at(const std::string& word);

[[nodiscard]] base::Result<Plan> read_plan(const std::string& path);
/// Throws std::system_error naming the file.
void write_plan(const Plan& plan, const std::string& path);

/// Gives the files that a plan holds, and no other.
[[nodiscard]] base::OpenFile opener_of(const Plan& plan);
/// Gives the files of this machine, and keeps them in a plan.
[[nodiscard]] base::OpenFile opener_into(Plan& plan);

} // namespace hapnet::lab

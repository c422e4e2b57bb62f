// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/text.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/result.hpp"

#include <map>
#include <string>

namespace hapnet::lab {

/// The contents of plan.json: an experiment with all its inputs, so that each of its shards, on any
/// machine, plays sessions of the same experiment.
struct Plan {
    std::string experiment; // the EXPERIMENT given to `hapnet-lab plan`
    experiment::Overrides overrides{};
    std::string criteria;                       // the value of its --criteria
    std::map<std::string, std::string> files{}; // the texts of all files that were read, by name
    std::string program; // program that made the plan: another one may play differently
};

inline constexpr const char* plan_name = "plan.json";

/// Returns the plan file that a word names, as a file or as its folder; empty: it names no plan.
[[nodiscard]] std::string plan_at(const std::string& word);

[[nodiscard]] base::Result<Plan> read_plan(const std::string& path);
/// Writes a plan to a file. Throws std::system_error that names the file.
void write_plan(const Plan& plan, const std::string& path);

/// Returns an opener that provides the files of a plan, and no others.
[[nodiscard]] base::OpenFile opener_of(const Plan& plan);
/// Returns an opener that provides the files of this machine and stores them in a plan.
[[nodiscard]] base::OpenFile opener_into(Plan& plan);

} // namespace hapnet::lab

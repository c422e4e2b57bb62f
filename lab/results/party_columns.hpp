// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"

#include <cstdint>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>

namespace hapnet::lab::results {

// How many played, and where: columns of a table in which that is not two in the task's own scene.

/// Fills the columns of a row.
template <typename Row>
void note_party(const experiment::Experiment& experiment, const experiment::Party& party, Row& row)
{
    const bool are_always_two = experiment.peers.size() == 1 && experiment.peers.front() == 2;
    if (!are_always_two) row.peers = party.peers;
    if (party.scene) row.scene = experiment.scenes[*party.scene].name;
}

/// The algorithm of a row as a page names it: "base, 3 peers, carry".
template <typename Row>
[[nodiscard]] std::string algorithm_and_party(const Row& row)
{
    std::string name = row.algorithm;
    if (row.peers) name += fmt::format(", {} peers", *row.peers);
    if (row.scene) name += ", " + *row.scene;
    return name;
}

} // namespace hapnet::lab::results

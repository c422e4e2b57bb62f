// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/experiment.hpp"
#include "lab/results/table.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace hapnet::lab::results {

/// The number of players and their scene. They are the last columns of a table unless all its
/// sessions have two players in the task's own scene.
struct PartyCells {
    std::optional<std::uint32_t> peers{};
    std::optional<std::string> scene{};
    /// The numbers of recorded people and of their trials, where such hands played.
    std::optional<std::size_t> subjects{};
    std::optional<std::size_t> trials{};
};
[[nodiscard]] inline PartyCells party_cells(const experiment::Experiment& experiment,
                                            const experiment::Party& party)
{
    PartyCells cells;
    const bool are_always_two = experiment.peers.size() == 1 && experiment.peers.front() == 2;
    if (!are_always_two) cells.peers = party.peers;
    if (party.scene) cells.scene = experiment.scenes[*party.scene].name;
    if (const auto& people = experiment.hands.people) {
        cells.subjects = people->subjects();
        cells.trials = people->trials.size();
    }
    return cells;
}

inline constexpr std::string_view party_columns = "peers?,scene?";

/// Returns the algorithm of a row as a page names it: "base, 3 peers, carry".
[[nodiscard]] inline std::string algorithm_and_party(const TableRow& row)
{
    std::string name = row.text("algorithm");
    if (const auto peers = row.text("peers"); !peers.empty()) name += ", " + peers + " peers";
    if (const auto scene = row.text("scene"); !scene.empty()) name += ", " + scene;
    return name;
}

} // namespace hapnet::lab::results

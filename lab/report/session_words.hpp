// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/text_table.hpp"
#include "lab/results/results.hpp"

#include <string>
#include <vector>

namespace hapnet::lab::report {

/// Describes the session in one sentence.
[[nodiscard]] std::string sentence_of(const results::RecordedSession& session);

/// True if the session was played in virtual time.
[[nodiscard]] bool is_virtual(const results::RecordedSession& session);

/// Describes the network's conditions. Where the records do not hold them, names the file that
/// does.
[[nodiscard]] std::string about_network(const results::RecordedSession& session);

/// Describes how the delays of one direction were measured between two peers, and how reliable they
/// are.
[[nodiscard]] std::string about_clocks(const results::RecordedSession& session);

/// The settings of both peers, with a column for each.
[[nodiscard]] records::TextTable settings_table(const results::RecordedSession& session);

/// Commands, and a line above them about their effect.
struct Repeat {
    std::string what;
    std::vector<std::string> commands;
};

/// Returns the commands that repeat the numbers, and those that repeat the session.
[[nodiscard]] std::vector<Repeat> repeats_of(const results::RecordedSession& session);

} // namespace hapnet::lab::report

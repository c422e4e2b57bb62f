// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/text_table.hpp"
#include "lab/results/results.hpp"

#include <string>
#include <vector>

namespace hapnet::lab::report {

/// What was played, in one sentence.
[[nodiscard]] std::string sentence_of(const results::RecordedSession& session);

/// Whether the session was played in virtual time.
[[nodiscard]] bool is_virtual(const results::RecordedSession& session);

/// What the network was asked to do; where the records do not hold it, which file does.
[[nodiscard]] std::string about_network(const results::RecordedSession& session);

/// How the delays of one direction were measured between two peers, and how far to trust them.
[[nodiscard]] std::string about_clocks(const results::RecordedSession& session);

/// What the configurations of both peers say, with a column for each.
[[nodiscard]] records::TextTable settings_table(const results::RecordedSession& session);

/// Commands below a line that says what they do.
struct Repeat {
    std::string what;
    std::vector<std::string> commands;
};

/// How to have the numbers again, and the session.
[[nodiscard]] std::vector<Repeat> repeats_of(const results::RecordedSession& session);

} // namespace hapnet::lab::report

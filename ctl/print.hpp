// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ctl/options.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace hapnet::ctl {

// Prints the answers of an emulator or a peer for people. A key that a program of another version
// does not send is shown as "-".

/// Returns the text for the answer to any command except watch.
[[nodiscard]] std::string in_words(const Options& options, const nlohmann::ordered_json& reply);

/// Prints the lines of a watch, with the rates since the previous line.
class WatchPrinter {
public:
    explicit WatchPrinter(bool is_terminal) : is_terminal_{is_terminal} {}

    /// Returns the text for the next answer. On a terminal it is a table that replaces the previous
    /// one, otherwise a line of key=value pairs.
    [[nodiscard]] std::string next(const nlohmann::ordered_json& reply);

private:
    [[nodiscard]] std::string rate(const std::string& pointer,
                                   const nlohmann::ordered_json& statistics) const;
    [[nodiscard]] std::string table(const nlohmann::ordered_json& statistics) const;
    [[nodiscard]] std::string peer_table(const nlohmann::ordered_json& statistics) const;
    [[nodiscard]] std::string line(const nlohmann::ordered_json& statistics) const;
    [[nodiscard]] std::string peer_line(const nlohmann::ordered_json& statistics) const;

    bool is_terminal_;
    std::optional<nlohmann::ordered_json> last_;
};

} // namespace hapnet::ctl

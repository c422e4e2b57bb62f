// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "ctl/options.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace hapnet::ctl {

// The answers of an emulator or a peer, for a person. A key that a program of another version does
// not send is shown as "-".

/// The answer to `command`, except those to watch.
[[nodiscard]] std::string in_words(const Options& options, const nlohmann::ordered_json& reply);

/// The lines of a watch, with rates since the line before.
class WatchPrinter {
public:
    explicit WatchPrinter(bool is_terminal) : is_terminal_{is_terminal} {}

    /// Returns the text that shows the next answer: on a terminal a table that replaces the last
    /// one, otherwise a line of key=value.
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

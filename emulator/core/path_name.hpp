// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "proto/base/result.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

// The names of the paths of one run, and of their two ways.
//
// | path                  | name       | up         | down         |
// |-----------------------|------------|------------|--------------|
// | the only one          | ""         | "up"       | "down"       |
// | of two peers          | "1-2"      | "1-2"      | "2-1"        |
// | of a link with a word | "wan"      | "wan.up"   | "wan.down"   |
// | of two commands of several | "a-b" | "a-b.up"   | "a-b.down"   |
// | of a client           | "client.3" | "client.3.up" | "client.3.down" |
// | of a flow             | "flow.voice" | "flow.voice.up" | "flow.voice.down" |
// | of one of several     | "1-2.flow.voice" | "1-2.flow.voice" | "2-1.flow.voice" |

/// The two parts of a path's name: the path between two ends, and the flow on it; either may be
/// empty.
struct PathParts {
    std::string_view path;
    std::string_view flow;
};
[[nodiscard]] PathParts parts_of(std::string_view name);

/// Returns the name of a flow on a path: "client.3" and "voice" give "client.3.flow.voice". Without
/// a flow it is the name of the path.
[[nodiscard]] std::string flow_path(std::string_view path, std::string_view flow);

/// Returns the name under which settings of many paths are stored that also apply to this one:
/// "flow.voice", or "" for a path that is no flow.
[[nodiscard]] std::string_view common_name(std::string_view name);

/// Returns the name of a way, one direction of a path, in the keys of settings.
[[nodiscard]] std::string way_name(std::string_view path, Direction direction);

/// Returns the prefix of the names of a way's random streams. It has '/' instead of '.':
/// "client/3/up".
[[nodiscard]] std::string stream_name(std::string_view path, Direction direction);

/// Does the same as stream_name() for streams that both directions share: "both", "client/3/both",
/// "1-2/both".
[[nodiscard]] std::string stream_name_of_both(std::string_view path);

/// Describes a way for people: "up: from A to B", "1-2: from 1 to 2", "2-1: from 2 to 1", "wan.up",
/// "client.3.down: from the server".
[[nodiscard]] std::string way_in_words(std::string_view path, Direction direction);

/// True if the path is named after two peers, such as "1-2".
[[nodiscard]] bool is_pair(std::string_view path);

/// Reads a name as --link accepts it: "1-2" with the lower number first, or a word.
[[nodiscard]] base::Result<std::string> parse_link_name(std::string_view text);

/// One way of a path, or both. An empty `path` means all paths.
struct Way {
    std::string path;
    std::optional<Direction> direction; // nullopt: both

    friend bool operator==(const Way&, const Way&) = default;
};
/// Parses the beginning of a key: "", "all", "both", "up", "1-2", "wan", "wan.up", "client.3.down",
/// "flow.voice.up"; nullopt when it cannot be such a name.
[[nodiscard]] std::optional<Way> parse_way(std::string_view text);

/// True if the text is the letter of a command, "a" to "h".
[[nodiscard]] bool is_command(std::string_view text);

/// True if the text is the name of the path between two commands, "a-c".
[[nodiscard]] bool is_of_commands(std::string_view path);

/// Returns the way from one peer to another, by their numbers, or from one command to another, by
/// their letters. The two must differ. The name of the path has the lower one first.
[[nodiscard]] Way way_between(std::string_view from, std::string_view to);

/// Returns the name of a client's path.
[[nodiscard]] std::string client_path(std::string_view number_or_address);

/// The names that paths of a run may have. By default a run has only one path.
struct PathNames {
    std::vector<std::string> links{};
    bool clients = false;                    // there may be paths of clients
    bool any = false;                        // the paths are not known yet: every name is valid
    std::vector<std::string> flows{};        // flows that each path has
    std::vector<std::string> without_rate{}; // flows that share the rate of the rest
    std::vector<std::string> untouched{};    // flows that have no conditions
    std::string without_links{};             // why no links exist; "": no reason is given

    [[nodiscard]] bool contains(std::string_view path) const;
    /// Returns why contains() is false: "there is no link 1-3: use one of 1-2, 2-3".
    [[nodiscard]] std::string refusal(std::string_view path) const;
};

} // namespace hapnet::emulator

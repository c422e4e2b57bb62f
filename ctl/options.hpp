// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/program.hpp"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::ctl {

/// The options of the command line. The program behind the socket checks most of the values.
struct Options {
    std::string socket;
    std::string command; // "show", "set", ...
    std::vector<std::pair<std::string, std::string>> settings;
    std::optional<base::Duration> lasting; // --for
    std::string file;                      // argument of apply and diff; "-" is stdin
    std::string until;
    std::string name; // argument of keep
    std::optional<base::Duration> last;
    std::optional<base::Duration> timeout;
    std::optional<base::Duration> every;
    bool of_frames = false; // watch --frames
    bool as_json = false;
    bool as_csv = false; // option of stats
};

/// Parses the command line. `default_socket` is the value of $HAPNET_SOCKET; nullptr if it is not
/// set.
[[nodiscard]] net::CommandLine<Options> parse_options(std::span<char*> words,
                                                      const char* default_socket);

} // namespace hapnet::ctl

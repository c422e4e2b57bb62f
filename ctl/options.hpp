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

namespace hapnet::emulator {

/// What the command line of hapnet-ctl asks for. The program behind the socket judges most of
/// it.
struct CtlOptions {
    std::string socket;
    std::string command; // "show", "set", ...
    std::vector<std::pair<std::string, std::string>> settings;
    std::optional<std::string> lasting; // --for
    std::string file;                   // of apply and diff; "-" is stdin
    std::string until;
    std::optional<std::string> timeout;
    std::optional<std::string> every;
    bool as_json = false;
};

[[nodiscard]] net::CommandLine<CtlOptions> parse_ctl_options(std::span<char*> words);

} // namespace hapnet::emulator

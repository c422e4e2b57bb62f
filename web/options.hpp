// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/net/program.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::web {

/// The options of the command line.
struct Options {
    std::string emulator;           // a control socket; empty: none
    std::vector<std::string> peers; // control sockets
    std::string lab;                // control socket of a virtual-time session; empty: none
    bool stage = false;             // may start daemons of its own
    std::string out;                // folder for the results of the stage
    std::string listen;             // an address without a port; empty: loopback
    std::uint16_t port = 8460;
    bool is_port_chosen = false;
    std::vector<std::string> hosts; // further host names that requests may use
    std::string token_file;         // empty: the program makes its own token
    std::string url_file;           // empty: none
    bool is_virtual = false;        // --virtual: the stage begins in virtual time
    bool keeps_stopped = false;     // --stopped: the stage waits for its button
};

[[nodiscard]] net::CommandLine<Options> parse_options(std::span<char*> words);

} // namespace hapnet::web

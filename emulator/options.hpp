// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/program.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace hapnet::emulator {

/// How much processor time may be spent on leaving on time.
enum class Timing : std::uint8_t { eco, precise, spin };
[[nodiscard]] std::string_view to_text(Timing timing);

/// What the command line asks for. Names are not looked up yet.
struct Options {
    net::HostPort listen_a;
    net::HostPort listen_b;
    std::optional<net::HostPort> a; // nullopt: adopt the first sender
    std::optional<net::HostPort> b;
    Path path;
    base::Seed seed{1};
    Timing timing = Timing::precise;
    base::Duration budget = std::chrono::milliseconds{1};
    std::optional<base::Duration> duration; // nullopt: until SIGINT or SIGTERM
    std::optional<std::string> stats;       // a file, or "-" for stdout
    std::optional<std::string> control;     // the path of a Unix socket
};

/// Reads the command line; the error names the option, what is wrong with it, and what would be
/// right.
[[nodiscard]] net::CommandLine<Options> parse_options(std::span<char*> words);

} // namespace hapnet::emulator

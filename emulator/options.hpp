// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

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
#include <vector>

namespace hapnet::emulator {

/// How much processor time may be spent on leaving on time.
enum class Timing : std::uint8_t { eco, precise, spin };
[[nodiscard]] std::string_view to_text(Timing timing);

/// A setting of the conditions as it was typed: "up.delay", "300ms".
struct TypedSetting {
    std::string key;
    std::string value;
};

/// What the command line asks for. Names are not looked up and files not opened yet.
struct Options {
    net::HostPort listen_a;
    net::HostPort listen_b;
    std::optional<net::HostPort> a; // nullopt: adopt the first sender
    std::optional<net::HostPort> b;
    std::optional<std::string> profile; // a file, or the name of a preset
    std::optional<std::string> netem;   // a sentence as tc-netem takes it
    std::vector<TypedSetting> settings; // they win over the profile
    std::optional<base::Seed> seed;     // wins over the profile's
    std::optional<std::string> replay;  // fates to apply instead of drawing
    Timing timing = Timing::precise;
    base::Duration budget = std::chrono::milliseconds{1};
    std::optional<base::Duration> duration; // nullopt: until SIGINT or SIGTERM
    std::optional<std::string> stats;       // a file, or "-" for stdout
    std::optional<std::string> fates;
    std::optional<std::string> capture;
    std::optional<std::string> control; // the path of a Unix socket
};

/// Reads the command line; the error names the option, what is wrong with it, and what would be
/// right.
[[nodiscard]] net::CommandLine<Options> parse_options(std::span<char*> words);

} // namespace hapnet::emulator

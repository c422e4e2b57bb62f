// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/tools/probe_statistics.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "proto/cli/command.hpp"
#include "proto/net/endpoint.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace hapnet::emulator {

/// `hapnet-emulator probe HOST:PORT`, and on the other side `hapnet-emulator probe --answer PORT`
struct ProbeOptions {
    std::optional<net::HostPort> target; // either this or `answer` is set
    std::optional<net::HostPort> answer; // address at which questions are answered
    base::Duration spacing = std::chrono::milliseconds{100};
    std::uint64_t count = tools::ProbeStatistics::questions_max;
    std::size_t bytes = 136; // size of a state in the paper's scene (docs/formats/wire.md)
    base::Duration wait = std::chrono::seconds{2}; // wait for answers after the last question
    std::optional<std::string> csv;
    bool as_json = false;
    bool is_quiet = false;
};

/// Adds the command to the program. After parse() the options hold what was typed.
cli::Command& add_probe(cli::Command& program, ProbeOptions& options);

/// Refuses options that contradict each other, and a command without HOST:PORT or --answer.
[[nodiscard]] base::Result<void> require_probe(const ProbeOptions& options,
                                               const cli::Command& command);

} // namespace hapnet::emulator

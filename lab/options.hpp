// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <variant>

namespace hapnet::lab {

/// `hapnet-lab analyse A B [--json]`
struct AnalyseCommand {
    std::string record_a;
    std::string record_b;
    bool json = false;
};

enum class ExportRows : std::uint8_t { ticks, messages };

/// `hapnet-lab export RECORD --csv [--rows ticks|messages]`
struct ExportCommand {
    std::string record;
    ExportRows rows = ExportRows::ticks;
};

/// `hapnet-lab demo-report FOLDER`: the end of scripts/demo.sh.
struct DemoReportCommand {
    std::string folder;
    std::string command; // what was typed
    std::string start;   // ISO 8601, UTC
    double wall_time_s = 0.0;
};

using Command = std::variant<AnalyseCommand, ExportCommand, DemoReportCommand>;

/// What the command line asks for. Otherwise the exit code: 0 after --help or --version, 2 after
/// a mistake; what there was to say has then been printed.
[[nodiscard]] tl::expected<Command, int> parse_command_line(int argc, const char* const* argv);

} // namespace hapnet::lab

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

using Command = std::variant<AnalyseCommand, ExportCommand>;

/// What the command line asks for. Otherwise the exit code: 0 after --help or --version, 2 after
/// a mistake; what there was to say has then been printed.
[[nodiscard]] tl::expected<Command, int> parse_command_line(int argc, const char* const* argv);

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/cli/keep_options.hpp"

#include "proto/base/formats.hpp"

#include <chrono>
#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <system_error>

namespace hapnet::cli {

namespace {

using namespace std::chrono_literals;

base::Result<std::string> parse_folder(const std::string& text)
{
    std::error_code trouble;
    if (std::filesystem::is_directory(text, trouble)) return text;
    return base::fail(fmt::format("'{}' is not a folder: make it first", text));
}

} // namespace

void add_keep(Command& program, KeepOptions& options, const std::string& what)
{
    program.option("--keep", "TIME",
                   fmt::format("Hold {} of the last TIME (1s to 10min) in memory, for 'hapnet-ctl "
                               "SOCKET keep NAME' to save; needs --keep-in and --control",
                               what),
                   cli::into(options.span, base::Time{1s, 10min}));
    program.option("--keep-in", "DIR", "The folder that --keep saves into; it must exist",
                   cli::into(options.folder, parse_folder));
}

base::Result<void> check_keep(const KeepOptions& options, bool has_control)
{
    if (options.span.has_value() == options.folder.empty()) {
        return base::fail("--keep TIME and --keep-in DIR go together");
    }
    if (options.span && !has_control) {
        return base::fail("--keep needs --control SOCKET: a client asks for what was kept");
    }
    return {};
}

} // namespace hapnet::cli

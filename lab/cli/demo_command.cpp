// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/demo_command.hpp"

#include "lab/cli/files.hpp"
#include "lab/cli/host.hpp"
#include "lab/cli/report_command.hpp"
#include "lab/results/demo.hpp"
#include "proto/net/result_file.hpp"

#include <filesystem>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab {

base::Result<bool> conclude_demo(const DemoReportCommand& command)
{
    for (const char* name : {"/p1/analysis.json", "/t3/analysis.json"}) {
        if (std::filesystem::exists(command.folder + name)) continue;
        return base::fail(fmt::format("{0} is not a folder of scripts/demo.sh: {0}{1} is missing",
                                      command.folder, name));
    }
    auto p1 = read_session_files(command.folder + "/p1");
    if (!p1) return tl::unexpected{p1.error()};
    auto t3 = read_session_files(command.folder + "/t3");
    if (!t3) return tl::unexpected{t3.error()};
    const results::DemoRun run{*std::move(p1), *std::move(t3)};
    const results::Circumstances circumstances{command.command, command.start, command.wall_time_s,
                                               host()};
    net::ResultFile{command.folder + "/manifest.json"}.commit(
        demo_manifest(run, circumstances).dump(2) + '\n');
    const auto page = write_report({command.folder, {}});
    if (!page) return tl::unexpected{page.error()};
    fmt::print("{}", demo_table(run));
    return demo_is_met(run);
}

} // namespace hapnet::lab

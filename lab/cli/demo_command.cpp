// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/demo_command.hpp"

#include "lab/cli/files.hpp"
#include "lab/cli/host.hpp"
#include "lab/cli/report_command.hpp"
#include "lab/results/demo.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/program.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab {

namespace {

bool is_analysed(const std::string& task_folder)
{
    return std::filesystem::exists(task_folder + "/analysis.json");
}

void write_manifest(const DemoReportCommand& command, const nlohmann::ordered_json& manifest)
{
    disk::ResultFile{command.folder + "/manifest.json"}.commit(manifest.dump(2) + '\n');
}

/// Concludes a demo with --peers or --scene. Its page and table are those of its one session.
base::Result<bool> conclude_circle(const DemoReportCommand& command, const std::string& task,
                                   const results::Circumstances& circumstances)
{
    auto files = read_session_files(command.folder + '/' + task);
    if (!files) return tl::unexpected{files.error()};
    const results::CircleDemo demo{task, *std::move(files)};
    write_manifest(command, circle_demo_manifest(demo, circumstances));
    net::print(circle_demo_verdict(demo));
    return circle_demo_is_valid(demo);
}

} // namespace

base::Result<bool> conclude_demo(const DemoReportCommand& command)
{
    const results::Circumstances circumstances{command.command, command.start, command.wall_time_s,
                                               host()};
    for (const char* task : {"t7", "t8"}) {
        if (is_analysed(command.folder + '/' + task))
            return conclude_circle(command, task, circumstances);
    }
    for (const char* task : {"/p1", "/t3"}) {
        if (is_analysed(command.folder + task)) continue;
        return base::fail(
            fmt::format("{0} is not a folder of scripts/demo.sh: {0}{1}/analysis.json is missing",
                        command.folder, task));
    }
    auto p1 = read_session_files(command.folder + "/p1");
    if (!p1) return tl::unexpected{p1.error()};
    auto t3 = read_session_files(command.folder + "/t3");
    if (!t3) return tl::unexpected{t3.error()};
    const results::DemoRun run{*std::move(p1), *std::move(t3)};
    write_manifest(command, demo_manifest(run, circumstances));
    const auto page = write_report({command.folder, {}});
    if (!page) return tl::unexpected{page.error()};
    net::print(demo_table(run));
    return demo_is_met(run) && demo_is_valid(run);
}

} // namespace hapnet::lab

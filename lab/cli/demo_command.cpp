// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/demo_command.hpp"

#include "lab/cli/host.hpp"
#include "lab/cli/json_file.hpp"
#include "lab/report/demo_page.hpp"
#include "lab/results/demo.hpp"
#include "proto/record/reader.hpp"

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <system_error>

namespace hapnet::lab {

namespace {

using Json = nlohmann::ordered_json;

base::Result<DemoTask> read_task(const std::string& folder)
{
    DemoTask task;
    for (auto [part, name] : {std::pair{&task.analysis, "/analysis.json"},
                              {&task.emulator, "/emulator.json"},
                              {&task.peer, "/peer-1.json"}}) {
        auto json = read_json(folder + name);
        if (!json) return tl::unexpected{json.error()};
        *part = *std::move(json);
    }
    return task;
}

base::Result<TaskTrace> read_trace(const std::string& folder)
{
    const auto a = record::read(folder + "/peer-1.rec");
    if (!a) return tl::unexpected{a.error()};
    const auto b = record::read(folder + "/peer-2.rec");
    if (!b) return tl::unexpected{b.error()};
    return common_session(*a, *b).map(
        [](const Session& session) { return task_trace_of(session); });
}

void write(const std::string& path, const std::string& text)
{
    std::ofstream file{path, std::ios::binary};
    file << text;
    if (!file.flush()) {
        throw std::system_error{errno, std::generic_category(), "cannot write " + path};
    }
}

} // namespace

base::Result<bool> conclude_demo(const DemoReportCommand& command)
{
    auto p1 = read_task(command.folder + "/p1");
    if (!p1) return tl::unexpected{p1.error()};
    auto t3 = read_task(command.folder + "/t3");
    if (!t3) return tl::unexpected{t3.error()};
    const auto p1_trace = read_trace(command.folder + "/p1");
    if (!p1_trace) return tl::unexpected{p1_trace.error()};
    const auto t3_trace = read_trace(command.folder + "/t3");
    if (!t3_trace) return tl::unexpected{t3_trace.error()};
    const DemoRun run{*std::move(p1), *std::move(t3)};
    const DemoCircumstances circumstances{command.command, command.start, command.wall_time_s,
                                          host()};
    write(command.folder + "/manifest.json", demo_manifest(run, circumstances).dump(2) + '\n');
    write(command.folder + "/report.html", demo_page(run, circumstances, *p1_trace, *t3_trace));
    fmt::print("{}", demo_table(run));
    return demo_is_met(run);
}

} // namespace hapnet::lab

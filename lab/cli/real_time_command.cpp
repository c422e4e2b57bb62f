// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/real_time_command.hpp"

#include "lab/cli/files.hpp"
#include "lab/cli/host.hpp"
#include "lab/cli/session_records.hpp"
#include "lab/cli/sweep_command.hpp"
#include "lab/results/real_time.hpp"
#include "lab/results/table_text.hpp"
#include "lab/virtual_time/play.hpp"
#include "proto/net/text_file.hpp"

#include <algorithm>
#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::lab {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Returns the folders of the sessions in a place, by name.
std::vector<fs::path> session_folders(const fs::path& place)
{
    std::vector<fs::path> folders;
    if (!fs::is_directory(place)) return folders;
    for (const auto& entry : fs::directory_iterator{place}) {
        if (entry.is_directory()) folders.push_back(entry.path());
    }
    std::ranges::sort(folders);
    return folders;
}

void tick_evenly(virtual_time::Setting& setting)
{
    for (virtual_time::PlayerSetting& player : setting.players) player.ticks.reset();
}

base::Result<results::RealTimeResult> result_in(const fs::path& folder, const std::string& where)
{
    auto files = read_session_files(folder.string());
    if (!files) return tl::unexpected{files.error()};
    results::RealTimeSession session{where, *std::move(files)};
    const std::size_t others = session.files.peer.value("others", Json::array()).size();
    const auto records = records_in(folder.string(), others + 1);
    if (!records) return tl::unexpected{records.error()};
    session.ticks = ticks_in(*records);
    auto setting = twin_of(session, net::text_of_file);
    // P1 is played over a path beside which a tick is short: it is compared with even ticks, as
    // Table 1 has them.
    if (setting && setting->task == device::Task::p1) tick_evenly(*setting);
    if (!setting) return base::fail(folder.string() + ": " + setting.error().message);
    const auto twin = play(*setting);
    if (!twin) return base::fail(folder.string() + ": " + twin.error().message);
    return result_of(session, *twin);
}

} // namespace

base::Result<std::string> conclude_real_time(const RealTimeCommand& command)
{
    if (command.next) return next_session(command);
    if (!command.played.empty()) return compare_session(command);
    if (is_sweep(command.folder)) return conclude_sweep(command);
    const fs::path folder{command.folder};
    std::vector<results::RealTimeResult> results;
    for (const char* where : {"loopback", "namespaces"}) {
        for (const fs::path& session : session_folders(folder / "real-time" / where)) {
            auto result = result_in(session, where);
            if (!result) return tl::unexpected{result.error()};
            results.push_back(*std::move(result));
        }
    }
    if (results.empty()) {
        return base::fail((folder / "real-time").string() +
                          " has no sessions: run scripts/real-time.sh --out " + folder.string() +
                          " first");
    }
    write_result_tables(command.folder, results::real_time_name, {real_time_rows(results)});
    const results::Circumstances circumstances{command.command, command.start, command.wall_time_s,
                                               host()};
    const auto noted =
        note_in_manifest(folder.string(), real_time_manifest(results, circumstances));
    if (!noted) return tl::unexpected{noted.error()};
    return real_time_table(results);
}

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/real_time_command.hpp"

#include "lab/cli/files.hpp"
#include "lab/cli/host.hpp"
#include "lab/results/real_time.hpp"
#include "lab/virtual_time/play.hpp"
#include "proto/net/result_file.hpp"
#include "proto/net/text_file.hpp"
#include "proto/record/reader.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::lab {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Where sessions were played, and the folders of those, by name.
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

/// Of each of the peers 1, 2, ... as its record says it.
base::Result<std::vector<base::Duration>> phases_in(const fs::path& folder, std::size_t peers)
{
    constexpr base::Duration tick{std::chrono::milliseconds{1}};
    std::vector<base::Duration> phases;
    for (std::size_t id = 1; id <= peers; ++id) {
        const auto path = (folder / fmt::format("peer-{}.rec", id)).string();
        const auto record = record::read(path);
        if (!record) return tl::unexpected{record.error()};
        if (record->ticks.empty()) return base::fail(path + " has no ticks");
        phases.push_back(record->ticks.back().due.time_since_epoch() % tick);
    }
    return phases;
}

base::Result<results::RealTimeResult> result_in(const fs::path& folder, const std::string& where)
{
    auto files = read_session_files(folder.string());
    if (!files) return tl::unexpected{files.error()};
    results::RealTimeSession session{where, *std::move(files)};
    // P1 is played over a path beside which a tick is short; the other tasks over some
    // milliseconds.
    const std::size_t others = session.files.peer.value("others", Json::array()).size();
    if (session.files.peer.value("task", "") != "P1") {
        auto phases = phases_in(folder, others + 1);
        if (!phases) return tl::unexpected{phases.error()};
        session.phases = *std::move(phases);
    }
    const auto setting = twin_of(session, net::text_of_file);
    if (!setting) return base::fail(folder.string() + ": " + setting.error().message);
    const auto twin = play(*setting);
    if (!twin) return base::fail(folder.string() + ": " + twin.error().message);
    return result_of(session, *twin);
}

/// Adds to the manifest that is there; without one, writes a manifest of its own.
base::Result<void> note_in_manifest(const fs::path& folder, Json real_time)
{
    const auto path = (folder / "manifest.json").string();
    Json manifest{{"kind", "real-time"},
                  {"title", "Real time beside virtual time"},
                  {"command", real_time.at("command")},
                  {"version", real_time.at("version")},
                  {"commit", real_time.at("commit")},
                  {"compiler", real_time.at("compiler")},
                  {"host", real_time.at("host")},
                  {"start", real_time.at("start")},
                  {"wall_time_s", real_time.at("wall_time_s")},
                  {"valid", real_time.at("valid")}};
    if (fs::exists(path)) {
        auto there = read_json(path);
        if (!there) return tl::unexpected{there.error()};
        if (there->value("kind", "") != "real-time") manifest = *std::move(there);
    }
    manifest["real_time"] = std::move(real_time);
    net::ResultFile{path}.commit(manifest.dump(2) + '\n');
    return {};
}

} // namespace

base::Result<std::string> conclude_real_time(const RealTimeCommand& command)
{
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
    net::ResultFile{(folder / "real_time.csv").string()}.commit(real_time_csv(results));
    const results::Circumstances circumstances{command.command, command.start, command.wall_time_s,
                                               host()};
    const auto noted = note_in_manifest(folder, real_time_manifest(results, circumstances));
    if (!noted) return tl::unexpected{noted.error()};
    return real_time_table(results);
}

} // namespace hapnet::lab

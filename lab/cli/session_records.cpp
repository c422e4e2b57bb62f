// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/session_records.hpp"

#include "lab/cli/files.hpp"
#include "lab/records/tick_times.hpp"
#include "proto/disk/result_file.hpp"

#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab {

namespace {

using Json = nlohmann::ordered_json;

} // namespace

base::Result<std::vector<record::Record>> records_in(const std::string& folder, std::size_t peers)
{
    std::vector<record::Record> records;
    for (std::size_t id = 1; id <= peers; ++id) {
        auto record = read_record(fmt::format("{}/peer-{}.rec", folder, id));
        if (!record) return tl::unexpected{record.error()};
        records.push_back(*std::move(record));
    }
    return records;
}

std::vector<std::vector<base::Duration>> ticks_in(const std::vector<record::Record>& records)
{
    std::vector<std::vector<base::Duration>> ticks;
    if (records.front().sessions.empty()) return ticks;
    const base::TimePoint start = records.front().sessions.back().start;
    for (const record::Record& record : records)
        ticks.push_back(records::tick_times(record, start));
    return ticks;
}

base::Result<void> note_in_manifest(const std::string& folder, Json real_time)
{
    const auto path = folder + "/manifest.json";
    Json manifest{{"kind", "real-time"}, {"title", "Real time beside virtual time"}};
    for (const char* key :
         {"command", "version", "commit", "compiler", "host", "start", "wall_time_s", "valid"}) {
        manifest[key] = real_time.at(key);
    }
    if (std::filesystem::exists(path)) {
        auto there = read_json(path);
        if (!there) return tl::unexpected{there.error()};
        if (there->value("kind", Json{}) != "real-time") manifest = *std::move(there);
    }
    manifest["real_time"] = std::move(real_time);
    disk::ResultFile{path}.commit(manifest.dump(2) + '\n');
    return {};
}

} // namespace hapnet::lab

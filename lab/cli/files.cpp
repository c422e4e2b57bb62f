// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/files.hpp"

#include "lab/records/recorded_settings.hpp"
#include "lab/results/table_text.hpp"
#include "peer/shared_object/load.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/program.hpp"
#include "proto/net/text_file.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <tuple>
#include <utility>

namespace hapnet::lab {

namespace {

using Json = nlohmann::ordered_json;

/// A key of a result file and the type of its value, if the file has the key.
struct TypedKey {
    const char* key;
    bool (*is_right)(const Json&);
    const char* type;
};

bool is_list_of_objects(const Json& json)
{
    return json.is_array() &&
           std::ranges::all_of(json, [](const Json& one) { return one.is_object(); });
}

bool is_way(const Json& json)
{
    if (!json.is_object()) return false;
    const Json dropped = json.value("dropped", Json::object());
    return dropped.is_object() &&
           std::ranges::all_of(dropped, [](const Json& count) { return count.is_number(); });
}

bool is_list(const Json& json) { return json.is_array(); }
bool is_flag(const Json& json) { return json.is_boolean(); }
bool is_text(const Json& json) { return json.is_string(); }

// The types that the code which reads these files relies on.
constexpr std::array analysis_keys{TypedKey{"invalid_because", is_list, "a list"}};
constexpr std::array emulator_keys{
    TypedKey{"valid", is_flag, "true or false"}, TypedKey{"invalid_because", is_list, "a list"},
    TypedKey{"up", is_way, "an object with counts of what was dropped"},
    TypedKey{"down", is_way, "an object with counts of what was dropped"}};
constexpr std::array peer_keys{TypedKey{"algorithm", is_text, "a text"},
                               TypedKey{"task", is_text, "a text"},
                               TypedKey{"others", is_list_of_objects, "a list of objects"}};

/// The JSON files, each with a table of it that older versions wrote only as CSV. A folder with the
/// CSV and without the JSON comes from an older version.
constexpr std::array<std::pair<std::string_view, std::string_view>, 14> written_as_csv{
    {{results::tables_name, "table1.csv"},
     {results::tables_name, "limits.csv"},
     {results::tables_name, "limits_by_axis.csv"},
     {results::tables_name, "limits_by_point.csv"},
     {results::tables_name, "qos.csv"},
     {results::tables_name, "qos_by_axis.csv"},
     {results::tables_name, "qos_by_point.csv"},
     {results::tables_name, "trajectories.csv"},
     {results::tables_name, "claims.csv"},
     {results::tables_name, "precision.csv"},
     {results::sessions_name, "sessions.csv"},
     {results::sessions_name, "sessions_by_axis.csv"},
     {results::sessions_name, "sessions_by_point.csv"},
     {results::real_time_name, "real_time.csv"}}};

/// Reads the object in a result file. The error names the file, and the key whose value has another
/// type.
base::Result<Json> read_result(const std::string& path, std::span<const TypedKey> keys)
{
    auto json = read_json(path);
    if (!json) return json;
    for (const TypedKey& one : keys) {
        const auto found = json->find(one.key);
        if (found == json->end() || one.is_right(*found)) continue;
        return base::fail(fmt::format("{}: '{}' is not {}", path, one.key, one.type));
    }
    return json;
}

} // namespace

base::Result<nlohmann::ordered_json> read_json(const std::string& path)
{
    const auto text = net::text_of_file(path);
    if (!text) return tl::unexpected{text.error()};
    auto json = nlohmann::ordered_json::parse(*text, nullptr, false);
    if (!json.is_object()) return base::fail(path + " does not hold one JSON object");
    return json;
}

base::Result<record::Record> read_record(const std::string& path)
{
    auto record = record::read(path);
    if (record && record->cut_off) {
        net::say("hapnet-lab", path + " ends inside a row, which is left out: its writer was "
                                      "killed or its disk was full");
    }
    if (record) {
        if (const auto fine = records::check_wire(record->config); !fine)
            return base::fail(fmt::format("{}: {}", path, fine.error().message));
    }
    return record;
}

base::Result<void> load_own_algorithms(experiment::Experiment& experiment)
{
    for (experiment::NamedAlgorithm& named : experiment.algorithms) {
        const auto loaded = peer::shared_object::load(named.algorithm);
        if (!loaded) return base::fail(fmt::format("{}: {}", named.name, loaded.error().message));
    }
    return {};
}

void create_folder(const std::string& path)
{
    if (path.empty()) return; // the folder of a file named without one
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) throw std::system_error{error, "cannot create the folder " + path};
}

base::Result<results::SessionFiles> read_session_files(const std::string& folder)
{
    results::SessionFiles files;
    for (auto [part, name, keys] :
         {std::tuple{&files.analysis, "/analysis.json", std::span<const TypedKey>{analysis_keys}},
          {&files.emulator, "/emulator.json", emulator_keys},
          {&files.peer, "/peer-1.json", peer_keys}}) {
        auto json = read_result(folder + name, keys);
        if (!json) return tl::unexpected{json.error()};
        *part = *std::move(json);
    }
    const std::size_t others = files.peer.value("others", nlohmann::ordered_json::array()).size();
    for (std::size_t id = 2; id <= others + 1; ++id) {
        const auto path = fmt::format("{}/peer-{}.json", folder, id);
        if (!std::filesystem::exists(path)) break;
        auto json = read_result(path, peer_keys);
        if (!json) return tl::unexpected{json.error()};
        files.others.push_back(*std::move(json));
    }
    return files;
}

base::Result<void> require_tables(const std::string& folder, std::string_view name)
{
    namespace fs = std::filesystem;
    if (fs::exists(fs::path{folder} / name)) return {};
    for (const auto& [file, csv] : written_as_csv) {
        if (file != name || !fs::exists(fs::path{folder} / csv)) continue;
        return base::fail(
            fmt::format("{} has {} and no {}, as an older version of hapnet-lab wrote "
                        "it: run it again: its sessions are reused",
                        folder, csv, name));
    }
    return {};
}

void write_result_tables(const std::string& folder, const std::string& name,
                         const std::vector<results::Table>& tables)
{
    for (const results::Table& table : tables)
        disk::ResultFile{fmt::format("{}/{}.csv", folder, table.name)}.commit(csv_text(table));
    disk::ResultFile{folder + '/' + name}.commit(results::json_text(tables));
}

} // namespace hapnet::lab

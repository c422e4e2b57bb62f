// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/cli/files.hpp"

#include "peer/shared_object/load.hpp"
#include "proto/net/program.hpp"
#include "proto/net/text_file.hpp"

#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <utility>

namespace hapnet::lab {

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
    if (record && record->config.value("program", "") == "hapnet-peer") {
        const auto wire = record->config.value("wire", std::int64_t{1}); // said from version 2 on
        if (wire != wire::protocol_version) {
            return base::fail(
                fmt::format("{}: its messages are of version {} of the wire, and this "
                            "program reads version {}: use the hapnet-lab of the "
                            "version that recorded it",
                            path, wire, wire::protocol_version));
        }
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
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) throw std::system_error{error, "cannot create the folder " + path};
}

base::Result<results::SessionFiles> read_session_files(const std::string& folder)
{
    results::SessionFiles files;
    for (auto [part, name] : {std::pair{&files.analysis, "/analysis.json"},
                              {&files.emulator, "/emulator.json"},
                              {&files.peer, "/peer-1.json"}}) {
        auto json = read_json(folder + name);
        if (!json) return tl::unexpected{json.error()};
        *part = *std::move(json);
    }
    const std::size_t others = files.peer.value("others", nlohmann::ordered_json::array()).size();
    for (std::size_t id = 2; id <= others + 1; ++id) {
        const auto path = fmt::format("{}/peer-{}.json", folder, id);
        if (!std::filesystem::exists(path)) break;
        auto json = read_json(path);
        if (!json) return tl::unexpected{json.error()};
        files.others.push_back(*std::move(json));
    }
    return files;
}

} // namespace hapnet::lab

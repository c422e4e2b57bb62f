// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/run_files.hpp"

#include "emulator/core/flow/flow.hpp"
#include "emulator/core/path_name.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/fates_file.hpp"
#include "emulator/profile_file.hpp"
#include "proto/net/text_file.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

using Json = nlohmann::ordered_json;

std::string text_at(const Json& statistics, const char* key)
{
    return statistics.contains(key) && statistics[key].is_string()
               ? statistics[key].get<std::string>()
               : "";
}

} // namespace

base::Result<Json> statistics_in(const std::string& text, const std::string& path)
{
    auto json = Json::parse(text, nullptr, /*allow_exceptions*/ false);
    if (json.is_object() && json.contains("up") && json.contains("profile")) return json;
    return base::fail(
        fmt::format("{} is not what --stats of hapnet-emulator writes: a run with --stats FILE "
                    "writes it",
                    path));
}

base::Result<Profile> profile_of_run(const Json& statistics, const std::string& path)
{
    const auto open = [&](const std::string& name) {
        return net::text_of_file(path_beside(name, path));
    };
    return parse_profile(text_at(statistics, "profile"), path, open);
}

base::Result<std::string> fates_path_of(const Json& statistics, const std::string& path)
{
    const std::string fates = text_at(statistics, "fates");
    if (fates.empty()) {
        return base::fail(fmt::format("{} names no fates: run with --fates and --stats", path));
    }
    if (std::filesystem::exists(fates)) return fates;
    return path_beside(std::filesystem::path{fates}.filename().string(), path);
}

base::Result<Fates> fates_of_path(const std::string& fates_path,
                                  const std::optional<std::string>& link)
{
    auto fates = read_fates(fates_path);
    if (!fates) return tl::unexpected{fates.error()};
    const auto own = fates->find(link.value_or(""));
    if (own != fates->end()) return std::move(own->second);
    if (fates->empty()) return Fates{}; // a run in which no datagram came
    std::vector<std::string_view> names;
    for (const auto& [name, of] : *fates) names.push_back(name);
    const auto flow = parts_of(link.value_or("")).flow;
    if (!flow.empty()) {
        std::ranges::replace(names, std::string_view{}, rest_of_flows);
        return base::fail(fmt::format("{} has no fates of {}: it has those of {}", fates_path,
                                      *link, fmt::join(names, ", ")));
    }
    if (names.size() == 1 && names.front().empty()) {
        return base::fail(fmt::format("{} has fates of one path: leave out --link", fates_path));
    }
    return base::fail(fmt::format("{} has fates of paths or flows: name one with --link: {}",
                                  fates_path, fmt::join(names, ", ")));
}

Json of_path(const Json& statistics, const std::optional<std::string>& link)
{
    const std::string of = link.value_or("");
    const std::string path{parts_of(of).path};
    const std::string flow{parts_of(of).flow};
    Json own = path.empty() ? Json::object() : Json();
    const auto links = statistics.value("links", Json::object());
    if (links.contains(path)) own = links[path];
    for (const Json& client : statistics.value("clients", Json::array())) {
        if (text_at(client, "name") == path) own = client;
    }
    if (!own.is_object()) return nullptr;
    Json all = statistics;
    if (!path.empty()) {
        all.erase("links");
        all.erase("clients");
    }
    all.update(own);
    if (!all.contains("flows")) return flow.empty() ? all : Json(nullptr);
    const auto name = flow.empty() ? std::string{rest_of_flows} : flow;
    if (!all["flows"].contains(name)) return nullptr;
    const Json of_flow = all["flows"][name];
    all.update(of_flow);
    return all;
}

base::Result<void> ensure_whole(const Fates& fates, const Json& statistics)
{
    for (const auto& [direction, of] : {std::pair{"up", &fates.up}, {"down", &fates.down}}) {
        const auto way = statistics.value(direction, Json::object());
        const auto received = way.find("received");
        if (received == way.end() || *received == of->size()) continue;
        return base::fail(fmt::format("the statistics count {} datagrams {}, and the fates are "
                                      "those of {}: they are not complete, or of another run",
                                      received->dump(), direction, of->size()));
    }
    return {};
}

base::Result<void> ensure_testable(const Json& statistics, const Profile& profile,
                                   const std::string& path)
{
    if (const auto replayed = text_at(statistics, "replay"); !replayed.empty()) {
        return base::fail(fmt::format("{} replayed {}: its fates are those, whatever its "
                                      "conditions say; verify the run that wrote them",
                                      path, replayed));
    }
    if (statistics.contains("generation") && statistics["generation"] != 1) {
        return base::fail("the conditions changed during the run: only what holds from the first "
                          "datagram to the last can be verified");
    }
    if (profile.timeline.empty()) return {};
    return base::fail("the profile changes during the run: only what holds from the first "
                      "datagram to the last can be verified");
}

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/several.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::lab::results {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kind = "several";

/// Returns a value; null where it is missing.
Json value_at(const Json& manifest, const char* key)
{
    const auto found = manifest.find(key);
    return found == manifest.end() ? Json(nullptr) : *found;
}

/// Returns "fig6a" for the folder "results/fig6a" in "results".
std::string name_in(std::string_view folder, std::string_view root)
{
    if (folder.starts_with(root)) folder.remove_prefix(root.size());
    while (folder.starts_with('/')) folder.remove_prefix(1);
    return std::string{folder};
}

} // namespace

bool is_of_several(const Json& manifest) { return value_at(manifest, "kind") == kind; }

Json several_manifest(const Results& results, const std::string& root, Circumstances circumstances)
{
    base::ensure(!results.runs.empty());
    Json parts = Json::array(), configuration = Json::object(), seeds = Json::object();
    Json reasons = Json::array();
    for (const Run& run : results.runs) {
        const auto name = name_in(run.folder, root);
        parts.push_back({{"folder", name},
                         {"command", value_at(run.manifest, "command")},
                         {"title", value_at(run.manifest, "title")},
                         {"valid", run.is_valid()}});
        configuration[name] = value_at(run.manifest, "configuration");
        seeds[name] = value_at(run.manifest, "seeds");
        if (!run.is_valid()) reasons.push_back(fmt::format("{} is not valid", name));
        const Json start = value_at(run.manifest, "start");
        const bool is_first =
            start.is_string() && (circumstances.start.empty() || start < circumstances.start);
        if (is_first) circumstances.start = start.get<std::string>();
        const Json wall_time = value_at(run.manifest, "wall_time_s");
        if (wall_time.is_number()) circumstances.wall_time_s += wall_time.get<double>();
    }
    Json manifest = manifest_head(circumstances);
    manifest.update({{"kind", kind},
                     {"title", fmt::format("{} folders of results", results.runs.size())},
                     {"results", std::move(parts)},
                     {"configuration", std::move(configuration)},
                     {"seeds", std::move(seeds)},
                     {"valid", reasons.empty()},
                     {"invalid_because", reasons}});
    return manifest;
}

} // namespace hapnet::lab::results

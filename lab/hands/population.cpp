// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/population.hpp"

#include "lab/hands/manifest.hpp"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>

namespace hapnet::lab::hands {

namespace {

base::Result<std::shared_ptr<const device::HandTrace>> read_way(const std::string& file,
                                                                const base::Reading& reading)
{
    const auto text = reading.open(file);
    if (!text) return tl::unexpected{text.error()};
    auto trace = device::parse_hand_trace(*text, file);
    if (!trace) return tl::unexpected{trace.error()};
    return std::make_shared<const device::HandTrace>(*std::move(trace));
}

} // namespace

double Trial::end_s() const
{
    double end = 0.0;
    for (const auto& way : ways)
        if (way) end = std::max(end, way->back().time_s);
    return end;
}

std::size_t Population::subjects() const
{
    std::set<std::string_view> all;
    for (const Trial& trial : trials) all.insert(trial.subject);
    return all.size();
}

std::string Population::name() const
{
    std::string_view path = folder;
    while (path.size() > 1 && path.ends_with('/')) path.remove_suffix(1);
    return std::string{path.substr(path.rfind('/') + 1)};
}

base::Result<Population> read_population(const std::string& folder, const base::Reading& reading)
{
    const std::string base = folder.ends_with('/') ? folder : folder + '/';
    const std::string file = base + std::string{manifest_name};
    const auto text = reading.open(file);
    if (!text) return tl::unexpected{text.error()};
    const auto manifest = parse_manifest(*text, file);
    if (!manifest) return tl::unexpected{manifest.error()};
    Population population{folder, {}};
    for (const ImportedTrial& imported : manifest->trials) {
        Trial trial{imported.subject, imported.trial, {}};
        for (std::size_t side = 0; side < 2; ++side) {
            if (side == 1 && !imported.b) continue;
            auto way = read_way(base + (side == 0 ? imported.a : *imported.b).script, reading);
            if (!way) return tl::unexpected{way.error()};
            trial.ways.at(side) = *std::move(way);
        }
        population.trials.push_back(std::move(trial));
    }
    return population;
}

} // namespace hapnet::lab::hands

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/shard.hpp"

#include "proto/base/text.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::experiment {

base::Result<Shard> parse_shard(std::string_view text)
{
    const auto slash = text.find('/');
    if (slash != std::string_view::npos) {
        const auto index = base::parse_count(text.substr(0, slash), shards_max);
        const auto count = base::parse_count(text.substr(slash + 1), shards_max);
        if (index && count && *index < *count) {
            return Shard{static_cast<std::uint32_t>(*index), static_cast<std::uint32_t>(*count)};
        }
    }
    return base::fail(fmt::format("'{}' is no shard: write I/N, from 0/N to N-1/N, N at most {}",
                                  text, shards_max));
}

ShardDeal::ShardDeal(const Shard& shard, const std::vector<Job>& first_jobs) : shard_{shard}
{
    for (const Job& job : first_jobs) std::ignore = number_of(twin_of(job));
    by_twins_ = twins_.size() >= shard.count;
}

bool ShardDeal::takes(const Job& job)
{
    const std::size_t number = by_twins_ ? number_of(twin_of(job)) : next_++;
    return number % shard_.count == shard_.index;
}

ShardDeal::Twin ShardDeal::twin_of(const Job& job)
{
    static constexpr std::size_t no_scene = SIZE_MAX;
    const auto of_spec = [](std::size_t algorithm, const SessionSpec& spec, std::size_t scene) {
        const virtual_time::Setting& setting = spec.setting;
        return Twin{algorithm, setting.task, static_cast<std::uint32_t>(setting.players.size()),
                    scene, setting.seed.value()};
    };
    if (const auto* session = std::get_if<SessionJob>(&job)) {
        return of_spec(session->algorithm, session->spec, session->party.scene.value_or(no_scene));
    }
    if (const auto* silence = std::get_if<SilenceJob>(&job))
        return of_spec(silence->algorithm, silence->spec, no_scene);
    const auto of_search = [](const auto& search) {
        return Twin{search.algorithm, search.task, search.party.peers,
                    search.party.scene.value_or(no_scene), std::uint64_t{0}};
    };
    const auto* search = std::get_if<SearchJob>(&job);
    return search != nullptr ? of_search(*search) : of_search(std::get<SensitivityJob>(job));
}

std::size_t ShardDeal::number_of(const Twin& twin)
{
    return twins_.emplace(twin, twins_.size()).first->second;
}

} // namespace hapnet::lab::experiment

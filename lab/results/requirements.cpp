// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/requirements.hpp"

#include "lab/results/party_columns.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::results {

namespace {

using experiment::Impairment;

/// Y.1541 limits the 1 - 10^-3 quantile of the delay less its minimum. A jitter J draws the delay
/// uniformly from 0 to 2 J.
constexpr double variation_of_jitter = 2.0 * (1.0 - 1e-3);

/// A tolerated level, and how it was found.
struct Borne {
    std::optional<double> level{};
    Bound bound{};
};

Borne borne(const TaskLimit& limit)
{
    if (limit.fails_at_rest) return {{}, Bound::none};
    return {limit.threshold.p50, limit.threshold.is_open ? Bound::open : Bound::found};
}

Borne scaled(Borne borne, double factor)
{
    if (borne.level) *borne.level *= factor;
    return borne;
}

void put(Borne borne, std::optional<double>& level, Bound& bound)
{
    level = borne.level;
    bound = borne.bound;
}

/// Writes the interval that the limit allows, rounded down to whole ticks, but at least one tick.
void put_interval(const TaskLimit& limit, base::Duration tick, Requirement& row)
{
    Borne interval = borne(limit);
    if (interval.level)
        *interval.level = std::max(1.0, std::floor(*interval.level)) * 1e3 * base::to_seconds(tick);
    put(interval, row.interval_ms, row.interval_bound);
    if (!interval.level) return;
    row.messages_per_s = 1e3 / *interval.level;
    if (limit.message_bits) row.rate_kbit_s = *limit.message_bits / *interval.level; // bit/ms
}

void put(const TaskLimit& limit, base::Duration tick, Requirement& row)
{
    const Borne found = borne(limit);
    switch (limit.impairment) {
    case Impairment::delay: return put(found, row.delay_ms, row.delay_bound);
    case Impairment::jitter:
        return put(scaled(found, variation_of_jitter), row.delay_variation_ms,
                   row.delay_variation_bound);
    case Impairment::random_loss: return put(found, row.loss_percent, row.loss_bound);
    case Impairment::burst_loss: return put(found, row.burst_of_100, row.burst_bound);
    case Impairment::interval: return put_interval(limit, tick, row);
    }
}

bool is_of(const Requirement& row, const Requirement& other)
{
    return row.algorithm == other.algorithm && row.task == other.task && row.tier == other.tier &&
           row.peers == other.peers && row.scene == other.scene;
}

std::string classes_of(const Requirement& requirement)
{
    std::string numbers;
    for (const NetworkClass& network : network_classes) {
        if (!suffices(network, requirement)) continue;
        numbers += fmt::format("{}{}", numbers.empty() ? "" : " ", network.number);
    }
    return numbers.empty() ? "none" : numbers;
}

} // namespace

bool suffices(const NetworkClass& network, const Requirement& requirement)
{
    const auto bears = [](std::optional<double> borne, double bound) {
        return borne && *borne >= bound;
    };
    const bool bears_variation =
        network.delay_variation_ms
            ? bears(requirement.delay_variation_ms, *network.delay_variation_ms)
            : requirement.delay_variation_bound == Bound::open;
    return bears_variation && bears(requirement.delay_ms, network.delay_ms) &&
           bears(requirement.loss_percent, network.loss_percent);
}

bool has_requirements(const experiment::Limits& limits)
{
    return ranges_of(limits).size() == experiment::impairments.size();
}

std::vector<Requirement> make_requirements(const experiment::Experiment& experiment,
                                           std::span<const TaskLimit> limits)
{
    std::vector<Requirement> rows;
    for (const TaskLimit& limit : limits) {
        const PartyCells party = party_cells(experiment, limit.party);
        Requirement row{.algorithm = limit.algorithm->name,
                        .task = std::string{limit.task},
                        .tier = limit.tier,
                        .seeds = limit.threshold.seeds,
                        .first_seed = experiment.first_seed,
                        .peers = party.peers,
                        .scene = party.scene};
        const auto known =
            std::ranges::find_if(rows, [&](const Requirement& one) { return is_of(one, row); });
        put(limit, experiment.tick,
            known == rows.end() ? rows.emplace_back(std::move(row)) : *known);
    }
    for (Requirement& row : rows) row.classes = classes_of(row);
    return rows;
}

Table requirements_table(const std::vector<Requirement>& requirements)
{
    return table_of("requirements", requirements);
}

Table network_classes_table()
{
    return table_of("network_classes",
                    std::vector<NetworkClass>{network_classes.begin(), network_classes.end()});
}

} // namespace hapnet::lab::results

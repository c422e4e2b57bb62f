// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/statistics.hpp"

#include "peer/core/sync/text.hpp"
#include "proto/net/clock.hpp"
#include "scene/text/text.hpp"

#include <algorithm>
#include <span>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer::monitor {

namespace {

// A run is valid when 99 % of its ticks are at most this late and at most this share is missed.
constexpr base::Duration late_budget{std::chrono::milliseconds{1}};
constexpr double missed_share_budget = 0.005;

} // namespace

std::span<const loop::OtherStatus> others_of(const loop::ServoStatus& status)
{
    return std::span{status.others}.first(status.others_count);
}

std::string PeerConfiguration::scene_toml() const { return scene::to_text(options->scene); }
std::string PeerConfiguration::scene_hash() const
{
    return fmt::format("{:016x}", scene::hash(options->scene));
}
std::string PeerConfiguration::algorithm_toml() const
{
    return print_algorithm(options->algorithm);
}

std::optional<std::string> PeerConfiguration::operator_name() const
{
    if (!options->device.is_simulated()) return std::nullopt;
    return options->device.person.name;
}

std::optional<std::string> PeerConfiguration::operator_toml() const
{
    if (!options->device.is_simulated()) return std::nullopt;
    return print_operator(options->device.person);
}

/// Of the roster: 0 is whoever answers.
std::vector<std::uint16_t> PeerConfiguration::peers() const
{
    return options->others.empty() ? std::vector<std::uint16_t>{} : options->roster().others;
}

std::string PeerConfiguration::boot_id() { return net::boot_id(); }

std::optional<SessionReport> PeerStatistics::session() const
{
    const auto& session = status().session;
    if (!session) return std::nullopt;
    SessionReport report{.number = {},
                         .seed = session->seed,
                         .role = status().is_left ? Role::left : Role::right,
                         .has_joined_late = session->joined_late,
                         .clock_offset = {},
                         .clock_uncertainty = {}};
    if (!status().is_pair()) return report;
    report.number = session->number;
    if (const auto& clock = status().others.front().clock) {
        report.clock_offset = clock->offset;
        report.clock_uncertainty = clock->uncertainty;
    }
    return report;
}

std::vector<OtherReport> PeerStatistics::others() const
{
    std::vector<OtherReport> others;
    for (const loop::OtherStatus& other : others_of(status())) others.push_back({&other});
    return others;
}

/// Counts are sums, and there is an agreement when there is one with each.
std::optional<line::Status::Key> PeerStatistics::secure() const
{
    std::optional<line::Status::Key> all;
    for (const loop::OtherStatus& other : others_of(status())) {
        const auto& key = other.line.key;
        if (!key) continue;
        if (!all) {
            all = key;
            continue;
        }
        all->is_agreed = all->is_agreed && key->is_agreed;
        if (key->age) all->age = std::max(all->age.value_or(*key->age), *key->age);
        all->counts += key->counts;
        all->misnamed += key->misnamed;
    }
    return all;
}

TickReport tick_report(const loop::LoopCounters& loop)
{
    return {.count = loop.ticks, .missed = loop.missed, .late = loop.late.quantiles()};
}

MessagesReport PeerStatistics::messages() const
{
    std::uint64_t strangers = 0;
    for (const loop::OtherStatus& other : others_of(status())) strangers += other.line.strangers;
    return {.counters = status().messages,
            .strangers = strangers,
            .overflowed = status().overflowed,
            .send_failed = status().loop.send_failures};
}

ForceReport PeerStatistics::governor() const
{
    return {.governor = {.state = status().governor_state,
                         .fault = status().fault,
                         .force_limit_n = status().force_limit_n,
                         .motor_heat = status().motor_heat,
                         .counters = status().governor,
                         .device = status().device},
            .watchdog_halts = status().watchdog_halts,
            .withheld = status().loop.withheld,
            .unusable_samples = status().messages.unusable_hand};
}

std::optional<EnergyReport> PeerStatistics::energy() const
{
    if (!status().energy_limits) return std::nullopt;
    return EnergyReport{status().governor.energy_limited, *status().energy_limits, status().energy};
}

std::uint64_t PeerStatistics::record_rows_lost() const
{
    return run->rows_lost + status().loop.unrecorded + status().loop.too_long;
}

std::optional<bool> PeerStatistics::is_record_whole() const
{
    return run->options.record ? std::optional{run->is_record_whole} : std::nullopt;
}

std::optional<std::string_view> PeerStatistics::refusal() const
{
    return status().refusal ? std::optional{describe(*status().refusal)} : std::nullopt;
}

bool PeerStatistics::is_valid() const { return why_not_valid(*run).empty(); }

std::string why_not_valid(const Run& run)
{
    const loop::LoopCounters& loop = run.status.loop;
    const auto p99 = loop.late.quantile(0.99);
    const double missed_share = tick_report(loop).missed_share();
    if (!p99) return "no tick began";
    if (missed_share > missed_share_budget) {
        return fmt::format("{:.2g} % of the ticks were missed, more than {} %", 1e2 * missed_share,
                           1e2 * missed_share_budget);
    }
    if (*p99 > late_budget) {
        return fmt::format("p99 lateness {:.0f} us, more than {:.0f} us",
                           base::to_seconds(*p99) * 1e6, base::to_seconds(late_budget) * 1e6);
    }
    // A fault that an operator has ended counts, too: the hand did not play meanwhile.
    if (const auto faults = run.status.governor.faults.total(); faults > 0) {
        return fmt::format("the device was at fault {}",
                           faults == 1 ? "once" : fmt::format("{} times", faults));
    }
    return run.options.record && !run.is_record_whole ? "the record is not complete" : "";
}

std::string_view describe(wire::ByeReason reason)
{
    switch (reason) {
    case wire::ByeReason::finished: return "finished";
    case wire::ByeReason::interrupted: return "interrupted";
    case wire::ByeReason::other_version:
        return "the other speaks another version of the protocol: use the same version of hapnet "
               "on both sides";
    case wire::ByeReason::other_scene:
        return "the other has another scene: give both the same --scene";
    case wire::ByeReason::other_task:
        return "the other has another task: give both the same --task";
    case wire::ByeReason::other_tick_rate:
        return "the other has another tick rate: use the same version of hapnet on both sides";
    case wire::ByeReason::same_id: return "the other has the same id: give the two different --id";
    }
    return "";
}

} // namespace hapnet::peer::monitor

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/statistics.hpp"

#include <algorithm>

namespace hapnet::peer::monitor {

namespace {

// The limits of a valid run: 99 % of its ticks are at most this late, and at most this share is
// missed.
constexpr base::Duration late_budget{std::chrono::milliseconds{1}};
constexpr double missed_share_budget = 0.005;

TickReport tick_report(const loop::LoopCounters& loop)
{
    return {.count = loop.ticks, .missed = loop.missed, .late = loop.late.quantiles()};
}

std::optional<SessionReport> session_of(const loop::ServoStatus& status)
{
    const auto& session = status.session;
    if (!session) return std::nullopt;
    SessionReport report{.number = {},
                         .seed = session->seed,
                         .role = status.is_left ? Role::left : Role::right,
                         .has_joined_late = session->joined_late,
                         .clock_offset = {},
                         .clock_uncertainty = {}};
    if (!status.is_pair()) return report;
    report.number = session->number;
    if (const auto& clock = status.others.front().clock) {
        report.clock_offset = clock->offset;
        report.clock_uncertainty = clock->uncertainty;
    }
    return report;
}

/// Returns the combined status of all keys: counts are added, and the keys count as agreed if each
/// of them is.
std::optional<line::Status::Key> all_keys(const loop::ServoStatus& status)
{
    std::optional<line::Status::Key> all;
    for (const loop::OtherStatus& other : others_of(status)) {
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

MessagesReport messages_of(const loop::ServoStatus& status)
{
    std::uint64_t strangers = 0;
    for (const loop::OtherStatus& other : others_of(status)) strangers += other.line.strangers;
    return {.counters = status.messages,
            .strangers = strangers,
            .overflowed = status.overflowed,
            .send_failed = status.loop.send_failures};
}

ForceReport governor_of(const loop::ServoStatus& status)
{
    return {.governor = {.state = status.governor_state,
                         .fault = status.fault,
                         .force_limit_n = status.force_limit_n,
                         .motor_heat = status.motor_heat,
                         .counters = status.governor,
                         .device = status.device},
            .watchdog_halts = status.watchdog_halts,
            .withheld = status.loop.withheld,
            .unusable_samples = status.messages.unusable_hand};
}

} // namespace

std::span<const loop::OtherStatus> others_of(const loop::ServoStatus& status)
{
    return std::span{status.others}.first(status.others_count);
}

PeerStatistics statistics_of(const Run& run)
{
    const loop::ServoStatus& status = run.status;
    PeerStatistics all{.configuration = {&run.options, run.device},
                       .session = session_of(status),
                       .others = {},
                       .secure = all_keys(status),
                       .tick = tick_report(status.loop),
                       .messages = messages_of(status),
                       .governor = governor_of(status),
                       .energy = {},
                       .record_rows_lost =
                           run.rows_lost + status.loop.unrecorded + status.loop.too_long,
                       .texts_lost = run.texts_lost,
                       .is_record_whole = {},
                       .are_events_whole = {},
                       .real_time = status.real_time,
                       .refusal = {},
                       .is_valid = why_not_valid(run).empty(),
                       .elapsed = {}};
    for (const loop::OtherStatus& other : others_of(status)) all.others.push_back({&other});
    if (const auto& limits = status.energy_limits) {
        all.energy = EnergyReport{status.governor.energy_limited, *limits, status.energy};
    }
    if (run.options.record) all.is_record_whole = run.is_record_whole;
    if (run.options.events) all.are_events_whole = run.are_events_whole;
    if (status.refusal) all.refusal = describe(*status.refusal);
    return all;
}

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
    // A fault that an operator has ended also counts, because the hand did not take part meanwhile.
    if (const auto faults = run.status.governor.faults.total(); faults > 0) {
        return fmt::format("the device was at fault {}",
                           faults == 1 ? "once" : fmt::format("{} times", faults));
    }
    if (run.options.record && !run.is_record_whole) return "the record is not complete";
    return run.options.events && !run.are_events_whole ? "events are missing" : "";
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

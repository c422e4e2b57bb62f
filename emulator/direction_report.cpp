// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/direction_report.hpp"

#include "emulator/core/statistics.hpp"
#include "emulator/core/verdict.hpp"
#include "emulator/stream_json.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::emulator {

namespace {

using Json = nlohmann::ordered_json;
using Microseconds = std::chrono::duration<double, std::micro>;

Json json_of(const base::DurationHistogram& lateness)
{
    return {{"p50", json_in_us(lateness.quantile(0.5))},
            {"p90", json_in_us(lateness.quantile(0.9))},
            {"p99", json_in_us(lateness.quantile(0.99))},
            {"p999", json_in_us(lateness.quantile(0.999))},
            {"max", json_in_us(lateness.max())}};
}

/// [[low, high, count], ...] in that unit.
template <typename Unit>
Json distribution_of(const base::DurationHistogram& histogram)
{
    Json list = Json::array();
    for (const auto& [low, high, count] : histogram.filled_bins()) {
        list.push_back({Unit{low}.count(), Unit{high}.count(), count});
    }
    return list;
}

Json json_of(const StreamTotals& stream, bool has_distributions)
{
    const StreamReport measured = stream.report();
    Json delay = json_in_ms(measured.delay);
    if (measured.delay_quantiles) delay.update(json_in_ms(measured.delay_quantiles));
    if (measured.delay && has_distributions) {
        using Milliseconds = std::chrono::duration<double, std::milli>;
        delay["distribution"] = distribution_of<Milliseconds>(stream.delays.delays());
    }
    return {{"requested_delay_ms", json_in_ms(measured.requested_delay)},
            {"delay_ms", delay},
            {"delay_variation_ms", json_in_ms(measured.delay_variation)},
            {"gap_ms", json_in_ms(measured.gap)},
            {"clumped", or_null(measured.clumped_share)},
            {"missing_run_updates",
             {{"count", measured.missing_runs.count},
              {"mean", or_null(measured.missing_runs.mean())},
              {"max", measured.missing_runs.max}}},
            {"reorder_extent",
             {{"count", measured.reordered.count},
              {"mean", or_null(measured.reordered.mean())},
              {"max", measured.reordered.max},
              {"beyond_look_back", measured.beyond_look_back}}},
            {"age_ms",
             {{"mean", json_in_ms(measured.age.mean)},
              {"peak_mean", json_in_ms(measured.age.peak_mean)},
              {"peak_max", json_in_ms(measured.age.peak_max)}}}};
}

/// "160.00 ms (sd 2.89)"
std::string in_words(const base::Moments& moments)
{
    const auto in_ms = [](base::Duration duration) { return 1e3 * base::to_seconds(duration); };
    return fmt::format("{:.2f} ms (sd {:.2f})", in_ms(moments.mean),
                       in_ms(moments.sd.value_or(base::Duration{0})));
}

/// Whether the emulator did what it was asked to, and nothing else.
std::string verdict(const DirectionOfRun& run, base::Duration budget)
{
    const auto reasons = reasons_against(run, budget);
    if (reasons.empty()) return "valid";
    constexpr std::uint64_t few = 100; // of fewer, p99 is the one that was latest
    const bool are_few = run.statistics.lateness.count() < few;
    const bool are_late = reasons_against(run, base::Duration::max()).size() < reasons.size();
    return fmt::format("NOT VALID: {}{}", fmt::join(reasons, "; "),
                       are_few && are_late ? "; p99 of so few datagrams is the latest of them"
                                           : "");
}

} // namespace

nlohmann::ordered_json json_in_us(std::optional<base::Duration> duration)
{
    if (!duration) return nullptr;
    return Microseconds{*duration}.count();
}

std::vector<std::string> reasons_against(const DirectionOfRun& run, base::Duration budget)
{
    return invalid_because(run.statistics, run.overflowed, budget);
}

nlohmann::ordered_json json_of(const DirectionOfRun& run, base::Duration budget)
{
    const Statistics& s = run.statistics;
    const auto reasons = reasons_against(run, budget);
    Json dropped = Json::object();
    for (const DropCause cause : drop_causes) {
        dropped[std::string{to_text(cause)}] = s.dropped_by(cause);
    }
    Json json{{"received", s.received},
              {"delivered", s.delivered},
              {"duplicated", s.duplicated},
              {"corrupted", s.corrupted},
              {"reordered", s.reordered},
              {"in_flight", s.in_flight},
              {"bytes_in", s.bytes_in},
              {"bytes_out", s.bytes_out},
              {"ce_in", s.ce_in},
              {"ce_marked", s.ce_marked},
              {"ce_out", s.ce_out},
              {"dropped", dropped},
              {"lateness_us", json_of(s.lateness)},
              {"sojourn_us", json_of(s.sojourn)},
              {"strangers", run.strangers},
              {"overflowed", run.overflowed},
              {"over_budget", s.late_beyond(budget)},
              {"valid", reasons.empty()},
              {"invalid_because", reasons}};
    if (run.has_distributions) {
        json["lateness_us"]["distribution"] = distribution_of<Microseconds>(s.lateness);
    }
    if (run.stream != nullptr) json["lens"] = json_of(*run.stream, run.has_distributions);
    return json;
}

std::string in_words(const char* title, const DirectionOfRun& run, base::Duration budget)
{
    const Statistics& s = run.statistics;
    std::string text = fmt::format("{}: {} received, {} delivered, {} in flight", title, s.received,
                                   s.delivered, s.in_flight);
    for (const DropCause cause : drop_causes) {
        if (s.dropped_by(cause) == 0) continue;
        text += fmt::format(", {} {}", s.dropped_by(cause), to_text(cause));
    }
    if (s.reordered > 0) text += fmt::format(", {} reordered", s.reordered);
    if (run.strangers > 0) text += fmt::format(", {} from strangers", run.strangers);
    if (const auto overflowed = run.overflowed; overflowed > 0) {
        text += fmt::format(", {} overflowed", overflowed);
    }
    if (const auto p99 = s.lateness.quantile(0.99)) {
        text +=
            fmt::format("; lateness {:.0f} us median, {:.0f} us p99, {:.0f} us at most: {}",
                        Microseconds{*s.lateness.quantile(0.5)}.count(), Microseconds{*p99}.count(),
                        Microseconds{*s.lateness.max()}.count(), verdict(run, budget));
    } else if (!reasons_against(run, budget).empty()) {
        text += ": " + verdict(run, budget);
    }
    if (run.stream == nullptr) return text + "\n";
    const StreamReport measured = run.stream->report();
    if (measured.requested_delay && measured.delay) {
        text += fmt::format("; delay {} as drawn, {} as it came out",
                            in_words(*measured.requested_delay), in_words(*measured.delay));
    }
    return text + "\n";
}

std::string in_short(const char* title, const DirectionOfRun& run)
{
    const Statistics& s = run.statistics;
    std::string text =
        fmt::format("{} {} in, {} out, {} lost", title, s.received, s.delivered, s.dropped_total());
    if (const auto p99 = s.lateness.quantile(0.99)) {
        text += fmt::format(", late p99 {:.0f} us", Microseconds{*p99}.count());
    }
    return text;
}

} // namespace hapnet::emulator

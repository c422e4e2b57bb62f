// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/report.hpp"

#include "emulator/control/settings.hpp"
#include "emulator/core/profile/settings.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/core/statistics.hpp"
#include "emulator/core/verdict.hpp"
#include "emulator/stream_json.hpp"
#include "proto/base/version.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

using Json = nlohmann::ordered_json;
using Microseconds = std::chrono::duration<double, std::micro>;

Json microseconds(std::optional<base::Duration> duration)
{
    if (!duration) return nullptr;
    return Microseconds{*duration}.count();
}

Json json_of(const base::DurationHistogram& lateness)
{
    return {{"p50", microseconds(lateness.quantile(0.5))},
            {"p90", microseconds(lateness.quantile(0.9))},
            {"p99", microseconds(lateness.quantile(0.99))},
            {"p999", microseconds(lateness.quantile(0.999))},
            {"max", microseconds(lateness.max())}};
}

template <typename T>
Json or_null(const std::optional<T>& value)
{
    return value ? Json(*value) : Json(nullptr);
}

/// What differs from the default, as a profile says it.
Json json_of(Direction direction, const Conditions& conditions)
{
    Json json = Json::object();
    for (const auto& [key, value] : texts_of(direction, to_patch(conditions))) {
        json[key.substr(key.find('.') + 1)] = value;
    }
    return json;
}

Json json_of(const StreamReport& measured)
{
    Json delay = json_in_ms(measured.delay);
    if (measured.delay_quantiles) delay.update(json_in_ms(measured.delay_quantiles));
    return {{"requested_delay_ms", json_in_ms(measured.requested_delay)},
            {"delay_ms", delay},
            {"delay_variation_ms", json_in_ms(measured.delay_variation)},
            {"gap_ms", json_in_ms(measured.gap)},
            {"clumped", or_null(measured.clumped_share)},
            {"missing_run_updates",
             {{"count", measured.missing_runs},
              {"mean", or_null(measured.missing_run_mean)},
              {"max", measured.missing_run_max}}},
            {"reorder_extent",
             {{"count", measured.reordered},
              {"mean", or_null(measured.reorder_extent_mean)},
              {"max", measured.reorder_extent_max},
              {"beyond_look_back", measured.beyond_look_back}}},
            {"age_ms",
             {{"mean", json_in_ms(measured.age_mean)},
              {"peak_mean", json_in_ms(measured.peak_age_mean)},
              {"peak_max", json_in_ms(measured.peak_age_max)}}}};
}

std::vector<std::string> reasons_against(const ports::Relay::Side& side, base::Duration budget)
{
    return invalid_because(side.link.statistics(), side.socket.overflowed(), budget);
}

Json json_of(const ports::Relay::Side& side, base::Duration budget)
{
    const Statistics& s = side.link.statistics();
    const auto reasons = reasons_against(side, budget);
    Json dropped = Json::object();
    for (const DropCause cause : drop_causes) {
        dropped[std::string{to_text(cause)}] = s.dropped_by(cause);
    }
    return {{"received", s.received},
            {"delivered", s.delivered},
            {"duplicated", s.duplicated},
            {"corrupted", s.corrupted},
            {"reordered", s.reordered},
            {"in_flight", s.in_flight},
            {"bytes_in", s.bytes_in},
            {"bytes_out", s.bytes_out},
            {"dropped", dropped},
            {"lateness_us", json_of(s.lateness)},
            {"strangers", side.strangers},
            {"overflowed", side.socket.overflowed()},
            {"over_budget", s.late_beyond(budget)},
            {"valid", reasons.empty()},
            {"invalid_because", reasons},
            {"lens", json_of(side.link.stream_statistics().report())}};
}

Json address_of(const ports::Relay::Side& side)
{
    const auto& address = side.filter.address();
    return address ? Json(address->to_text()) : Json(nullptr);
}

/// "160.00 ms (sd 2.89)"
std::string in_words(const Moments& moments)
{
    const auto in_ms = [](base::Duration duration) { return 1e3 * base::to_seconds(duration); };
    return fmt::format("{:.2f} ms (sd {:.2f})", in_ms(moments.mean),
                       in_ms(moments.sd.value_or(base::Duration{0})));
}

/// Whether the emulator did what it was asked to, and nothing else.
std::string verdict(const ports::Relay::Side& side, base::Duration budget)
{
    constexpr std::uint64_t judged_min = 100; // of fewer, p99 is the one that was latest
    const bool are_too_few = side.link.statistics().lateness.count() < judged_min;
    const auto reasons = reasons_against(side, are_too_few ? base::Duration::max() : budget);
    if (!reasons.empty()) return fmt::format("NOT VALID: {}", fmt::join(reasons, "; "));
    return are_too_few ? "too few datagrams to judge" : "valid";
}

/// What is missing in the files that were asked for.
std::string incomplete(const Recorder& recorder)
{
    std::string text;
    if (recorder.has_failed()) text += "NOT COMPLETE: a file of this run could not be written\n";
    if (const auto lost = recorder.fates_lost(); lost > 0) {
        text += fmt::format("NOT COMPLETE: the fates lack {} datagrams\n", lost);
    }
    if (const auto lost = recorder.capture_lost(); lost > 0) {
        text += fmt::format("NOT COMPLETE: the capture lacks {} packets\n", lost);
    }
    return text;
}

std::string in_words(const char* title, const ports::Relay::Side& side, base::Duration budget)
{
    const Statistics& s = side.link.statistics();
    std::string text = fmt::format("{}: {} received, {} delivered, {} in flight", title, s.received,
                                   s.delivered, s.in_flight);
    for (const DropCause cause : drop_causes) {
        if (s.dropped_by(cause) == 0) continue;
        text += fmt::format(", {} {}", s.dropped_by(cause), to_text(cause));
    }
    if (s.reordered > 0) text += fmt::format(", {} reordered", s.reordered);
    if (side.strangers > 0) text += fmt::format(", {} from strangers", side.strangers);
    if (const auto overflowed = side.socket.overflowed(); overflowed > 0) {
        text += fmt::format(", {} overflowed", overflowed);
    }
    if (const auto p99 = s.lateness.quantile(0.99)) {
        text +=
            fmt::format("; lateness {:.0f} us median, {:.0f} us p99, {:.0f} us at most: {}",
                        Microseconds{*s.lateness.quantile(0.5)}.count(), Microseconds{*p99}.count(),
                        Microseconds{*s.lateness.max()}.count(), verdict(side, budget));
    } else if (!reasons_against(side, budget).empty()) {
        text += ": " + verdict(side, budget);
    }
    const StreamReport measured = side.link.stream_statistics().report();
    if (measured.requested_delay && measured.delay) {
        text += fmt::format("; delay {} as drawn, {} as it came out",
                            in_words(*measured.requested_delay), in_words(*measured.delay));
    }
    return text + "\n";
}

std::string in_short(const char* title, const ports::Relay::Side& side)
{
    const Statistics& s = side.link.statistics();
    std::string text =
        fmt::format("{} {} in, {} out, {} lost", title, s.received, s.delivered, s.dropped_total());
    if (const auto p99 = s.lateness.quantile(0.99)) {
        text += fmt::format(", late p99 {:.0f} us", Microseconds{*p99}.count());
    }
    return text;
}

} // namespace

std::string ready_line(const Run& run)
{
    return fmt::format("ready a={} b={} seed={} timing={}\n",
                       run.relay.a().socket.local().to_text(),
                       run.relay.b().socket.local().to_text(), run.scenario.seed.value(),
                       to_text(run.options.timing));
}

std::string endpoints_line(const ports::Relay& relay)
{
    const auto in_words = [](const ports::Relay::Side& side) {
        const auto& address = side.filter.address();
        return address ? address->to_text() : std::string{"not known yet"};
    };
    return fmt::format("a is {}, b is {}", in_words(relay.a()), in_words(relay.b()));
}

std::string statistics_json(const Run& run)
{
    const Options& options = run.options;
    const ports::Relay::Side& a = run.relay.a();
    const ports::Relay::Side& b = run.relay.b();
    std::vector<std::string> reasons;
    for (const auto& [way, side] : {std::pair{"up", &a}, std::pair{"down", &b}}) {
        for (const std::string& reason : reasons_against(*side, options.budget)) {
            reasons.push_back(fmt::format("{}: {}", way, reason));
        }
    }
    const Json json{
        {"program", "hapnet-emulator"},
        {"version", base::version()},
        {"commit", base::commit()},
        {"compiler", base::compiler()},
        {"seed", run.scenario.seed.value()},
        {"timing", to_text(options.timing)},
        {"budget_us", microseconds(options.budget)},
        {"duration_s", base::to_seconds(run.elapsed)},
        {"real_time",
         {{"fifo", run.real_time.fifo}, {"locked_memory", run.real_time.locked_memory}}},
        {"listen_a", a.socket.local().to_text()},
        {"listen_b", b.socket.local().to_text()},
        {"a", address_of(a)},
        {"b", address_of(b)},
        {"strangers", a.strangers + b.strangers},
        {"overflowed", a.socket.overflowed() + b.socket.overflowed()},
        {"generation", run.director.generation()},
        {"configuration",
         {{"up", json_of(Direction::up, run.scenario.profile.path.up)},
          {"down", json_of(Direction::down, run.scenario.profile.path.down)}}},
        {"profile", to_text(run.scenario.profile)},
        {"fates", or_null(options.fates)},
        {"replay", or_null(options.replay)},
        {"capture", or_null(options.capture)},
        {"fates_lost", run.recorder.fates_lost()},
        {"capture_lost", run.recorder.capture_lost()},
        {"valid", reasons.empty()},
        {"invalid_because", reasons},
        {"up", json_of(a, options.budget)},
        {"down", json_of(b, options.budget)},
    };
    return json.dump(2) + "\n";
}

std::string summary(const Run& run)
{
    return fmt::format("{:.1f} s, seed {}\n", base::to_seconds(run.elapsed),
                       run.scenario.seed.value()) +
           in_words("up   (A to B)", run.relay.a(), run.options.budget) +
           in_words("down (B to A)", run.relay.b(), run.options.budget) + incomplete(run.recorder);
}

std::string status_line(const Run& run)
{
    return fmt::format("{:.0f} s | {} | {}", base::to_seconds(run.elapsed),
                       in_short("up", run.relay.a()), in_short("down", run.relay.b()));
}

} // namespace hapnet::emulator

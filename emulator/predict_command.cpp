// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/commands.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/scenario.hpp"
#include "emulator/stream_json.hpp"
#include "emulator/tools/describe.hpp"
#include "emulator/tools/predict.hpp"
#include "proto/base/version.hpp"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

using Json = nlohmann::ordered_json;

/// By which a sealed message is longer than the plain one.
constexpr std::size_t seal_bytes = 16;
constexpr std::size_t payload_bytes_max = 65'507; // of UDP over IPv4

double in_ms(base::Duration duration)
{
    return std::chrono::duration<double, std::milli>{duration}.count();
}

Json json_of(std::optional<double> number) { return number ? Json(*number) : Json(nullptr); }

double share_of(std::uint64_t part, const tools::DirectionPrediction& of)
{
    const auto departures = of.statistics.delivered - of.statistics.duplicated;
    return departures == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(departures);
}

/// A direction of a prediction, and what was asked for it.
struct Predicted {
    const tools::DirectionPrediction& of;
    const Conditions& conditions;
    const tools::Stream& stream;
    bool has_timeline;
};

Json json_of(const Predicted& predicted)
{
    const auto& [of, conditions, stream, has_timeline] = predicted;
    const auto why = why_unsettled(conditions, stream, of, has_timeline);
    Json precision = nullptr;
    if (of.precision && !has_timeline) {
        precision = {{"mean", of.precision->mean}, {"sd", of.precision->sd}};
    }
    Json dropped = Json::object();
    for (const DropCause cause : drop_causes) {
        if (of.statistics.dropped_by(cause) == 0) continue;
        dropped[std::string{to_text(cause)}] = of.statistics.dropped_by(cause);
    }
    const StreamReport& measured = of.measured;
    return {{"theory", describe(conditions, stream)},
            {"warnings", warnings(conditions, stream, of)},
            {"received", of.statistics.received},
            {"delivered", of.statistics.delivered},
            {"duplicated", of.statistics.duplicated},
            {"corrupted", of.statistics.corrupted},
            {"dropped", dropped},
            {"loss",
             {{"share", of.loss_share()},
              {"runs", of.loss_runs.count},
              {"run_mean", json_of(of.loss_runs.mean())},
              {"run_max", of.loss_runs.max}}},
            {"requested_delay_ms", json_in_ms(measured.requested_delay)},
            {"delay_ms", json_in_ms(measured.delay)},
            {"delay_quantiles_ms", json_in_ms(measured.delay_quantiles)},
            {"settled", why.empty()},
            {"unsettled_because", why.empty() ? Json(nullptr) : Json(why)},
            {"precision", std::move(precision)},
            {"added_by_queues_ms", in_ms(of.added_by_queues)},
            {"jitter_ms", json_in_ms(measured.delay_variation)},
            {"gap_ms", json_in_ms(measured.gap)},
            {"clumped_share", json_of(measured.clumped_share)},
            {"reordered_share", share_of(measured.reordered.count, of)},
            {"reorder_extent",
             {{"mean", json_of(measured.reordered.mean())}, {"max", measured.reordered.max}}},
            {"age_ms",
             {{"mean", json_in_ms(measured.age.mean)},
              {"peak_max", json_in_ms(measured.age.peak_max)}}}};
}

std::string in_words(const std::optional<base::Quantiles>& quantiles)
{
    if (!quantiles) return "none";
    return fmt::format("p50 {:.4g}, p90 {:.4g}, p99 {:.4g}, p99.9 {:.4g}, max {:.4g} ms",
                       in_ms(quantiles->p50), in_ms(quantiles->p90), in_ms(quantiles->p99),
                       in_ms(quantiles->p999), in_ms(quantiles->max));
}

std::string in_words(const std::optional<base::Moments>& moments)
{
    if (!moments) return "none";
    return fmt::format("mean {:.4g} ms, sd {:.4g} ms", in_ms(moments->mean),
                       in_ms(moments->sd.value_or(base::Duration{})));
}

/// "mean to 0.2 %, sd to 0.9 % (95 %)"
std::string settling_in_words(const Predicted& predicted)
{
    const auto& [of, conditions, stream, has_timeline] = predicted;
    const auto why = why_unsettled(conditions, stream, of, has_timeline);
    std::string text = "  settled    ";
    if (of.precision && !has_timeline) {
        text += fmt::format("{}mean to {:.2g} %, sd to {:.2g} % (95 %)",
                            why.empty() ? "" : "NO: ", 100.0 * of.precision->mean,
                            100.0 * of.precision->sd);
        if (!why.empty()) text += "; ";
    } else if (why.empty()) {
        text += "too few delays to tell";
    }
    return text + why + "\n";
}

std::string in_words(std::string_view title, const Predicted& predicted)
{
    const auto& [of, conditions, stream, has_timeline] = predicted;
    const StreamReport& measured = of.measured;
    std::string text = fmt::format("{}\n", title);
    for (const auto& stage : describe(conditions, stream)) {
        text += fmt::format("  theory     {}\n", stage);
    }
    const auto& s = of.statistics;
    text += fmt::format("  datagrams  {} in, {} out, {} copies, {} damaged{}\n", s.received,
                        s.delivered, s.duplicated, s.corrupted,
                        stream.is_sealed ? ", which are refused and count as lost" : "");
    text += fmt::format("  loss       {:.4g} %", 100.0 * of.loss_share());
    if (of.loss_runs.count > 0) {
        text += fmt::format(", runs of {:.4g} on average, {} at most", *of.loss_runs.mean(),
                            of.loss_runs.max);
    }
    text += "\n";
    for (const DropCause cause :
         {DropCause::rate_queue_full, DropCause::rate_queue_law, DropCause::queue_full}) {
        if (s.dropped_by(cause) == 0) continue;
        text += fmt::format("  dropped    {} by {}\n", s.dropped_by(cause), to_text(cause));
    }
    text += fmt::format("  drawn      {}\n", in_words(measured.requested_delay));
    text += fmt::format("  delay      {}; {:+.4g} ms by the order and the queue\n",
                        in_words(measured.delay), in_ms(of.added_by_queues));
    text += fmt::format("             {}\n", in_words(measured.delay_quantiles));
    text += settling_in_words(predicted);
    text += fmt::format("  variation  {} (IPDV)\n", in_words(measured.delay_variation));
    text += fmt::format("  reordered  {:.4g} %", 100.0 * share_of(measured.reordered.count, of));
    if (measured.reordered.count > 0) {
        text += fmt::format(", by {:.3g} places on average, {} at most",
                            measured.reordered.mean().value_or(0.0), measured.reordered.max);
    }
    text += "\n";
    text += fmt::format("  clumped    {:.4g} % of the gaps are below 50 us\n",
                        100.0 * measured.clumped_share.value_or(0.0));
    for (const auto& warning : warnings(conditions, stream, of)) {
        text += fmt::format("  warning    {}\n", warning);
    }
    return text;
}

} // namespace

base::Result<int> run(const PredictOptions& options)
{
    std::vector<std::string> netem_warnings;
    const auto profile = profile_for_path(options.conditions, options.stream.path, netem_warnings);
    if (!profile) return tl::unexpected{profile.error()};
    for (const std::string& warning : netem_warnings) net::say("hapnet-emulator", warning);
    tools::Stream stream = options.stream;
    if (stream.is_sealed) stream.bytes = std::min(stream.bytes + seal_bytes, payload_bytes_max);
    const auto seed = seed_of(options.conditions, *profile);
    const auto [up, down] =
        options.packets_max ? predict_until_settled(*profile, stream, seed, *options.packets_max)
                            : predict(*profile, stream, seed);
    stream.packets = up.statistics.received;
    const bool has_timeline = !profile->timeline.empty();
    const Predicted of_up{up, profile->path.up, stream, has_timeline};
    const Predicted of_down{down, profile->path.down, stream, has_timeline};
    if (options.as_json) {
        const Json json{{"program", "hapnet-emulator predict"},
                        {"version", base::version()},
                        {"profile", options.conditions.profile.value_or(profile->name)},
                        {"link", stream.path.empty() ? Json(nullptr) : Json(stream.path)},
                        {"seed", seed.value()},
                        {"rate_hz", 1.0 / base::to_seconds(stream.spacing)},
                        {"packets", stream.packets},
                        {"bytes", stream.bytes},
                        {"sealed", stream.is_sealed},
                        {"up", json_of(of_up)},
                        {"down", json_of(of_down)}};
        fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
        return 0;
    }
    fmt::print("{} datagrams of {} B at {:.6g}/s each way, seed {}\n\n{}\n{}", stream.packets,
               stream.bytes, 1.0 / base::to_seconds(stream.spacing), seed.value(),
               in_words(way_in_words(stream.path, Direction::up), of_up),
               in_words(way_in_words(stream.path, Direction::down), of_down));
    return 0;
}

} // namespace hapnet::emulator

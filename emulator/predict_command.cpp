// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/commands.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/scenario.hpp"
#include "emulator/tools/predict.hpp"
#include "emulator/tools/prediction_report.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/base/version.hpp"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <vector>

namespace hapnet::emulator {

namespace {

/// The bytes by which a sealed message is longer than the plain one.
constexpr std::size_t seal_bytes = 16;
constexpr std::size_t payload_bytes_max = 65'507; // largest UDP payload over IPv4

double in_ms(base::Duration duration)
{
    return std::chrono::duration<double, std::milli>{duration}.count();
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

/// Returns "mean to 0.2 %, sd to 0.9 % (95 %)".
std::string settling_in_words(const tools::DirectionForecast& forecast)
{
    const auto why = forecast.why_unsettled();
    std::string text = "  settled    ";
    if (const auto precision = forecast.precision()) {
        text +=
            fmt::format("{}mean to {:.2g} %, sd to {:.2g} % (95 %)",
                        why.empty() ? "" : "NO: ", 100.0 * precision->mean, 100.0 * precision->sd);
        if (!why.empty()) text += "; ";
    } else if (why.empty()) {
        text += "too few delays to tell";
    }
    return text + why + "\n";
}

std::string in_words(std::string_view title, const tools::DirectionForecast& forecast)
{
    const tools::DirectionPrediction& of = *forecast.of;
    const StreamReport& measured = of.measured;
    std::string text = fmt::format("{}\n", title);
    for (const auto& stage : forecast.theory()) {
        text += fmt::format("  theory     {}\n", stage);
    }
    const auto& s = of.statistics;
    text += fmt::format("  datagrams  {} in, {} out, {} copies, {} damaged{}\n", s.received,
                        s.delivered, s.duplicated, s.corrupted,
                        forecast.stream->is_sealed ? ", which are refused and count as lost" : "");
    text += fmt::format("  loss       {:.4g} %", 100.0 * of.loss_share());
    if (of.loss_runs.count > 0) {
        text += fmt::format(", runs of {:.4g} on average, {} at most", *of.loss_runs.mean(),
                            of.loss_runs.max);
    }
    text += "\n";
    for (const DropCause cause :
         {DropCause::rate_queue_full, DropCause::rate_queue_law, DropCause::queue_full}) {
        if (s.dropped[cause] == 0) continue;
        text += fmt::format("  dropped    {} by {}\n", s.dropped[cause], to_text(cause));
    }
    text += fmt::format("  drawn      {}\n", in_words(measured.requested_delay));
    text += fmt::format("  delay      {}; {:+.4g} ms by the order and the queue\n",
                        in_words(measured.delay), in_ms(of.added_by_queues));
    text += fmt::format("             {}\n", in_words(measured.delay_quantiles));
    text += settling_in_words(forecast);
    text += fmt::format("  variation  {} (IPDV)\n", in_words(measured.delay_variation));
    text += fmt::format("  reordered  {:.4g} %", 100.0 * forecast.reordered_share());
    if (measured.reordered.count > 0) {
        text += fmt::format(", by {:.3g} places on average, {} at most",
                            measured.reordered.mean().value_or(0.0), measured.reordered.max);
    }
    text += "\n";
    text += fmt::format("  clumped    {:.4g} % of the gaps are below 50 us\n",
                        100.0 * measured.clumped_share.value_or(0.0));
    for (const auto& warning : forecast.warnings()) {
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
    const tools::PredictionReport report{
        .version = base::version(),
        .profile = options.conditions.profile.value_or(profile->name),
        .link = stream.path.empty() ? std::nullopt : std::optional{stream.path},
        .seed = seed.value(),
        .rate_hz = 1.0 / base::to_seconds(stream.spacing),
        .packets = stream.packets,
        .bytes = stream.bytes,
        .is_sealed = stream.is_sealed,
        .up = {&up, &profile->path.up, &stream, has_timeline},
        .down = {&down, &profile->path.down, &stream, has_timeline}};
    if (options.as_json) {
        const auto json = base::json_of(report);
        fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
        return 0;
    }
    fmt::print("{} datagrams of {} B at {:.6g}/s each way, seed {}\n\n{}\n{}", stream.packets,
               stream.bytes, report.rate_hz, report.seed,
               in_words(way_in_words(stream.path, Direction::up), report.up),
               in_words(way_in_words(stream.path, Direction::down), report.down));
    return 0;
}

} // namespace hapnet::emulator

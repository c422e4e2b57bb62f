// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/tools/predict.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/value_kind.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator::tools {

/// Runs of losses.
struct LossReport {
    double share = 0.0;
    base::Tally runs;
};
constexpr auto fields_of(base::Tag<LossReport>)
{
    using L = LossReport;
    return base::fields(
        "loss", base::member("share", &L::share, "The share of all that was lost."),
        base::computed<L>(
            "runs", [](const L& loss) { return loss.runs.count; }, "Runs of losses."),
        base::computed<L>(
            "run_mean", [](const L& loss) { return loss.runs.mean(); }, "Their mean length."),
        base::computed<L>(
            "run_max", [](const L& loss) { return loss.runs.max; }, "That of the longest."));
}

} // namespace hapnet::emulator::tools

namespace hapnet::emulator {

/// The fields that `predict` prints.
constexpr auto fields_of(base::Tag<StreamReport>)
{
    using S = StreamReport;
    return base::fields(
        "stream",
        base::member("requested_delay_ms", &S::requested_delay,
                     "The delays as drawn, before queues and order."),
        base::member("delay_ms", &S::delay, "The delays as they came out."),
        base::member("delay_quantiles_ms", &S::delay_quantiles, "Their quantiles."),
        base::member("jitter_ms", &S::delay_variation, "|IPDV| (RFC 3393)."),
        base::member("gap_ms", &S::gap, "The time between two departures."),
        base::member("clumped_share", &S::clumped_share,
                     "Share of these gaps that are below 50 µs."),
        base::member("reorder_extent", &S::reordered,
                     "By how many departures those came too late that were out of order."),
        base::member("age_ms", &S::age, "The age of information at the output."));
}

} // namespace hapnet::emulator

namespace hapnet::emulator::tools {

/// The report on one direction of a prediction, and its conditions. Everything that it refers to
/// must outlive it.
struct DirectionForecast {
    const DirectionPrediction* of = nullptr;
    const Conditions* conditions = nullptr;
    const Stream* stream = nullptr;
    bool has_timeline = false;

    [[nodiscard]] std::vector<std::string> theory() const;
    [[nodiscard]] std::vector<std::string> warnings() const;
    [[nodiscard]] std::string why_unsettled() const;
    /// Returns the precision; nullopt when nothing settles.
    [[nodiscard]] std::optional<Precision> precision() const;
    /// Returns the drops by cause. Only the causes that occurred are listed.
    [[nodiscard]] base::Entries<std::uint64_t> dropped() const;
    /// Returns the share of departures that were out of order.
    [[nodiscard]] double reordered_share() const;
};
constexpr auto fields_of(base::Tag<DirectionForecast>)
{
    using D = DirectionForecast;
    return base::fields(
        "direction",
        base::computed<D>(
            "theory", [](const D& one) { return one.theory(); },
            "What theory says of each stage, a sentence each."),
        base::computed<D>(
            "warnings", [](const D& one) { return one.warnings(); },
            "What is probably not meant so, a sentence each."),
        base::computed<D>("received", [](const D& one) { return one.of->statistics.received; }),
        base::computed<D>("delivered", [](const D& one) { return one.of->statistics.delivered; }),
        base::computed<D>("duplicated", [](const D& one) { return one.of->statistics.duplicated; }),
        base::computed<D>("corrupted", [](const D& one) { return one.of->statistics.corrupted; }),
        base::computed<D>(
            "dropped", [](const D& one) { return one.dropped(); },
            "By cause: only the causes that occurred."),
        base::computed<D>(
            "loss",
            [](const D& one) {
                return LossReport{one.of->loss_share(), one.of->loss_runs};
            },
            "What does not come; with `--sealed`, damaged datagrams, too."),
        base::computed<D>(
            "settled", [](const D& one) { return one.why_unsettled().empty(); },
            "Whether mean and deviation of the delay are known to 1 %."),
        base::computed<D>(
            "unsettled_because",
            [](const D& one) {
                auto why = one.why_unsettled();
                return why.empty() ? std::nullopt : std::optional{std::move(why)};
            },
            "Why they are not."),
        base::computed<D>(
            "precision", [](const D& one) { return one.precision(); },
            "Half the width of a 95 % interval, as a share of the value. null: nothing settles."),
        base::computed<D>(
            "added_by_queues_ms", [](const D& one) { return one.of->added_by_queues; },
            "Mean delay beyond the drawn one: rate and order."),
        base::computed<D>(
            "reordered_share", [](const D& one) { return one.reordered_share(); },
            "Share of the departures that were out of order (RFC 4737)."),
        base::computed_part<D>(
            [](const D& one) -> const StreamReport& { return one.of->measured; }));
}

/// The output of `predict --json`.
struct PredictionReport {
    std::string_view program = "hapnet-emulator predict";
    std::string_view version;
    std::string profile;
    std::optional<std::string> link;
    std::uint64_t seed = 0;
    double rate_hz = 0.0;
    std::uint64_t packets = 0;
    std::uint64_t bytes = 0;
    bool is_sealed = false;
    DirectionForecast up;
    DirectionForecast down;
};
constexpr auto fields_of(base::Tag<PredictionReport>)
{
    using P = PredictionReport;
    return base::fields(
        "prediction", base::member("program", &P::program), base::member("version", &P::version),
        base::member("profile", &P::profile, "The file, or the name of the profile."),
        base::member("link", &P::link, "Which of several paths; null: the only one."),
        base::member("seed", &P::seed), base::member("rate_hz", &P::rate_hz, "Datagrams a second."),
        base::member("packets", &P::packets, "How many were played each way."),
        base::member("bytes", &P::bytes, "Payload of each."),
        base::member("sealed", &P::is_sealed, "Whether damaged ones count as lost."),
        base::member("up", &P::up, "From A to B."), base::member("down", &P::down, "From B to A."));
}

} // namespace hapnet::emulator::tools

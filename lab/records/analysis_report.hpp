// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/analysis.hpp"
#include "lab/records/text_table.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/value_kind.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::lab::records {

/// The report on two of several peers. The loops of all peers are reported once, elsewhere.
struct PairReport {
    const Analysis* of = nullptr;
};
constexpr auto fields_of(base::Tag<PairReport>)
{
    using P = PairReport;
    return base::fields(
        "pair", base::computed_part<P>([](const P& pair) -> const Agreement& {
            return pair.of->agreement;
        }),
        base::computed<P>(
            "a_to_b", [](const P& pair) -> const auto& { return pair.of->a_to_b; },
            "The path from the lower id. `sent` is known to the sender's record for the first of "
            "its others; for the rest it is the highest number that came."),
        base::computed<P>(
            "b_to_a", [](const P& pair) -> const auto& { return pair.of->b_to_a; },
            "The path to the lower id, likewise."),
        base::computed<P>(
            "clock", [](const P& pair) -> const auto& { return pair.of->clock; },
            "How both clocks were compared."),
        base::computed<P>(
            "valid", [](const P& pair) { return pair.of->valid(); },
            "Whether the run of these two is [valid](#what-valid-means)."),
        base::computed<P>(
            "invalid_because",
            [](const P& pair) -> const auto& { return pair.of->invalid_because; },
            "The reasons as a list of texts; empty when valid."));
}

/// The output of `analyse --json`: docs/formats/statistics.md.
struct AnalysisReport {
    /// The analysis of the two peers. With more peers it is that of the first two by their ids,
    /// with the worst discrepancies of all pairs.
    Analysis all;
    /// The pair whose copies were farthest apart on average. The inner nullopt: no pair was ever
    /// compared. The outer nullopt: there are only two peers.
    std::optional<std::optional<std::string>> worst_pair{};
    std::optional<base::Entries<PairReport>> pairs{};
    std::optional<base::Entries<LoopReport>> peers{};
};
constexpr auto fields_of(base::Tag<AnalysisReport>)
{
    using R = AnalysisReport;
    return base::fields(
        "analysis report", base::part(&R::all),
        base::member("worst_pair", &R::worst_pair,
                     "Of three to eight records: the two whose copies were farthest apart on "
                     "average, such as `\"1-3\"`.")
            .left_out_if_none(),
        base::member("pairs", &R::pairs,
                     "Likewise every two, by their ids: all keys above but `a` and `b`.")
            .left_out_if_none(),
        base::member("peers", &R::peers, "Likewise the loop of each, as `a` and `b`, by its id.")
            .left_out_if_none());
}

/// Returns an analysis for programs: units are in the names; null stands for a missing value.
[[nodiscard]] nlohmann::ordered_json to_json(const Analysis& analysis);

/// Returns an analysis for people, as tables: distances, touch, network, loops.
[[nodiscard]] std::vector<TextTable> tables_of(const Analysis& analysis);

/// Describes the difference of two clocks; empty when one clock made both records.
[[nodiscard]] std::string clock_text(const Clock& clock);

/// Returns an analysis for people, as lines of text: the tables, and whether the run counts.
[[nodiscard]] std::string to_table(const Analysis& analysis);

/// Reports on more than two peers. They have the keys of the report on the first two by their ids,
/// with the discrepancies of the worst pair. `pairs` has the data of each pair, `peers` the loop of
/// each peer.
[[nodiscard]] nlohmann::ordered_json to_json(const CircleAnalysis& circle);
[[nodiscard]] std::vector<TextTable> tables_of(const CircleAnalysis& circle);
[[nodiscard]] std::string to_table(const CircleAnalysis& circle);

} // namespace hapnet::lab::records

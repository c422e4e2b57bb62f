// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/records/agreement.hpp"
#include "lab/records/loop.hpp"
#include "lab/records/path.hpp"
#include "lab/records/session.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/result.hpp"
#include "proto/record/reader.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::lab::records {

/// The analysis of two records of one session: how far the copies were apart, how the network
/// treated the messages, how well both loops kept their time, and whether the run counts.
struct Analysis {
    Agreement agreement;
    Path a_to_b;
    Path b_to_a;
    Loop a;
    Loop b;
    Clock clock;
    /// The reasons why the run does not count, for people; empty: it does.
    std::vector<std::string> invalid_because;

    [[nodiscard]] bool valid() const { return invalid_because.empty(); }
};

constexpr auto fields_of(base::Tag<Analysis>)
{
    using A = Analysis;
    return base::fields("analysis", base::part(&A::agreement),
                        base::member("a_to_b", &A::a_to_b, "The path of the messages from A to B."),
                        base::member("b_to_a", &A::b_to_a, "That from B to A."),
                        base::computed<A>(
                            "a", [](const A& one) { return LoopReport{one.a}; }, "The loop of A."),
                        base::computed<A>(
                            "b", [](const A& one) { return LoopReport{one.b}; }, "The loop of B."),
                        base::member("clock", &A::clock, "How both clocks were compared."),
                        base::computed<A>(
                            "valid", [](const A& one) { return one.valid(); },
                            "Whether the run is [valid](#what-valid-means)."),
                        base::member("invalid_because", &A::invalid_because,
                                     "The reasons as a list of texts; empty when valid."));
}

/// Analyses two records. Fails for records that cannot be compared. A run that went badly is
/// analysed and marked as not valid.
[[nodiscard]] base::Result<Analysis> analyse(const record::Record& a, const record::Record& b);

/// The analysis of two peers of a session, the lower id as A.
struct PairAnalysis {
    std::int64_t id_a = 0;
    std::int64_t id_b = 0;
    Analysis analysis;

    [[nodiscard]] std::string name() const; // ids of both peers, such as "1-2"
};

/// The analysis of one session of three to eight peers: every two of their records are compared.
struct CircleAnalysis {
    /// The pairs in the order of their ids: 1-2, 1-3, 2-3.
    std::vector<PairAnalysis> pairs;
    /// The loop of each peer, by its id.
    std::map<std::int64_t, Loop> loops;
    std::vector<std::string> invalid_because;

    [[nodiscard]] bool valid() const { return invalid_because.empty(); }
    /// Returns the pair whose copies were farthest apart on average; nullptr: none was ever
    /// compared.
    [[nodiscard]] const PairAnalysis* worst() const;
    /// Returns the largest value of all pairs; nullopt: no pair was recorded so far into the
    /// session.
    [[nodiscard]] std::optional<double> settled_discrepancy() const;
    [[nodiscard]] std::optional<double> settled_turned_apart() const;
    /// Returns, for each body and each of its quantities, the worst value of all pairs.
    [[nodiscard]] std::vector<BodyAgreement> bodies() const;
};

/// Analyses three to eight records. Fails when analyse() fails for any two of them. The error names
/// the two by their place.
[[nodiscard]] base::Result<CircleAnalysis> analyse_circle(std::span<const record::Record> records);

} // namespace hapnet::lab::records

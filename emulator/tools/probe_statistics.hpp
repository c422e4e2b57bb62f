// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/tools/probe_message.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/figures/arrivals.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator::tools {

/// An answer that arrived.
struct ProbeReply {
    std::uint64_t sequence = 0;
    base::Duration round_trip{}; // does not include the time in the answering program
    base::Duration there{};      // this and `back` are valid if clocks_are_one()
    base::Duration back{};
    bool is_copy = false; // an answer to the question arrived before
};

/// Delays of one direction. Quantiles are values that occurred.
struct ProbeDelays {
    base::Duration min{};
    base::Duration mean{};
    base::Duration p50{};
    base::Duration p99{};
    base::Duration max{};
};
constexpr auto fields_of(base::Tag<ProbeDelays>)
{
    using D = ProbeDelays;
    return base::fields("delays", base::member("min", &D::min), base::member("mean", &D::mean),
                        base::member("p50", &D::p50), base::member("p99", &D::p99),
                        base::member("max", &D::max));
}

struct ProbeWay {
    std::optional<ProbeDelays> delay;
    std::optional<ProbeDelays> ipdv;
    std::uint64_t lost = 0;
};
constexpr auto fields_of(base::Tag<ProbeWay>)
{
    using W = ProbeWay;
    return base::fields(
        "way", base::member("lost", &W::lost),
        base::member("delay_ms", &W::delay,
                     "null: there are no answers, or one way was measured by two clocks."),
        base::member("ipdv_ms", &W::ipdv,
                     "|IPDV| (RFC 3393). null: no two questions in a row were answered."));
}

struct ProbeSummary {
    std::uint64_t sent = 0;
    std::uint64_t answered = 0;
    std::uint64_t copies = 0;
    std::uint64_t reordered = 0;
    bool clocks_are_one = false;
    ProbeWay round_trip{};
    ProbeWay there{};
    ProbeWay back{};
    std::uint64_t unknown = 0;

    /// Returns the share of questions without an answer.
    [[nodiscard]] double loss() const;
};
constexpr auto fields_of(base::Tag<ProbeSummary>)
{
    using S = ProbeSummary;
    return base::fields(
        "summary", base::member("sent", &S::sent, "Questions."),
        base::member("answered", &S::answered, "Questions with an answer at least."),
        base::computed<S>(
            "loss", [](const S& summary) { return summary.loss(); },
            "The share of the questions that have none."),
        base::member("copies", &S::copies, "Answers beyond the first."),
        base::member("reordered", &S::reordered,
                     "Answers that came after one to a later question."),
        base::member("clocks_are_one", &S::clocks_are_one, "Whether both ends read one clock."),
        base::member("round_trip", &S::round_trip),
        base::member("there", &S::there, "The questions; lost are those up to the last answered."),
        base::member("back", &S::back, "Their answers."),
        base::member("lost_on_unknown_way", &S::unknown,
                     "Questions after the last one that was answered."));
}

/// The output of `probe --json`.
struct ProbeReport {
    std::string_view program = "hapnet-emulator";
    std::string_view version;
    std::string target;
    ProbeSummary summary;
};
constexpr auto fields_of(base::Tag<ProbeReport>)
{
    using R = ProbeReport;
    return base::fields(
        "probe", base::member("program", &R::program), base::member("version", &R::version),
        base::member("target", &R::target, "Who was asked."), base::part(&R::summary));
}

/// The statistics of a probe: the questions that it sent and the answers that came back. Does no
/// I/O and reads no clock.
class ProbeStatistics {
public:
    /// `boot` is the number of this machine's boot.
    ProbeStatistics(std::uint64_t session, std::uint64_t boot) : session_{session}, boot_{boot} {}

    /// The greatest number of questions. Each has a row in memory.
    static constexpr std::uint64_t questions_max = 10'000'000;

    /// Returns the next question, which leaves at `now`. Ensures that there were fewer than
    /// questions_max.
    [[nodiscard]] ProbeMessage next_question(base::TimePoint now);

    /// Takes an answer. Returns nullopt if it does not belong to any of these questions.
    std::optional<ProbeReply> on_answer(const ProbeMessage& answer, base::TimePoint arrived);

    [[nodiscard]] std::uint64_t sent() const { return rows_.size(); }
    [[nodiscard]] bool all_answered() const { return answers_.counts().received == rows_.size(); }
    [[nodiscard]] base::Duration longest_round_trip() const { return longest_; }

    /// True if both ends read one clock: they are of one boot, and no delay by it is negative.
    [[nodiscard]] bool clocks_are_one() const
    {
        return clocks_are_one_ && answers_.counts().received > 0;
    }

    [[nodiscard]] ProbeSummary summary() const;

    /// Returns a table with a header and a line for each question; docs/use/probe.md describes the
    /// columns.
    [[nodiscard]] std::string csv() const;

private:
    struct Row {
        base::TimePoint sent{};
        base::Duration there{}; // if measured by two clocks, it includes their offset
        base::Duration back{};
        std::uint32_t answers = 0;
    };

    [[nodiscard]] ProbeWay way(base::Duration (*delay)(const Row&), bool is_known) const;

    std::uint64_t session_;
    std::uint64_t boot_;
    std::vector<Row> rows_; // indexed by sequence number
    base::ArrivalCounter answers_{0};
    std::uint64_t heard_ = 0; // number of questions received by the other side, as last reported
    base::Duration longest_{};
    bool clocks_are_one_ = true;
};

} // namespace hapnet::emulator::tools

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/process.hpp"

namespace hapnet::emulator {

namespace {

template <typename JudgeType>
struct WorkedBy {
    using Judge = JudgeType;
};

/// Which judge works by a law, and what the law is called.
template <typename Law>
struct About;
template <>
struct About<RandomLoss> : WorkedBy<RandomJudge> {
    static constexpr std::string_view name = "random";
};
template <>
struct About<BlockLoss> : WorkedBy<BlockJudge> {
    static constexpr std::string_view name = "k-of-n";
};
template <>
struct About<PeriodicLoss> : WorkedBy<PeriodicJudge> {
    static constexpr std::string_view name = "every";
};
template <>
struct About<Burst> : WorkedBy<BurstJudge> {
    static constexpr std::string_view name = "burst";
};
template <>
struct About<TimedBurst> : WorkedBy<TimedBurstJudge> {
    static constexpr std::string_view name = "timed-burst";
};
template <>
struct About<Gilbert> : WorkedBy<TwoStateJudge> {
    static constexpr std::string_view name = "gilbert";
};
template <>
struct About<GilbertElliott> : WorkedBy<TwoStateJudge> {
    static constexpr std::string_view name = "gilbert-elliott";
};
template <>
struct About<TimedGilbertElliott> : WorkedBy<TimedTwoStateJudge> {
    static constexpr std::string_view name = "timed-gilbert-elliott";
};
template <>
struct About<FourState> : WorkedBy<FourStateJudge> {
    static constexpr std::string_view name = "four-state";
};
template <>
struct About<ListedLoss> : WorkedBy<ListJudge> {
    static constexpr std::string_view name = "list";
};
template <>
struct About<PatternLoss> : WorkedBy<PatternJudge> {
    static constexpr std::string_view name = "pattern";
};
template <>
struct About<TraceLoss> : WorkedBy<TraceJudge> {
    static constexpr std::string_view name = "trace";
};
template <>
struct About<Outage> : WorkedBy<OutageJudge> {
    static constexpr std::string_view name = "outage";
};

template <typename Law>
using JudgeOf = typename About<Law>::Judge;

} // namespace

std::string_view name_of(const LossLaw& law)
{
    return std::visit([]<typename Law>(const Law&) { return About<Law>::name; }, law);
}

LossProcess::LossProcess(const LossLaw& law, const base::RandomStream& stream)
    : stream_{stream}, judge_{judge_of(law, stream)}
{}

LossProcess::Judge LossProcess::judge_of(const LossLaw& law, const base::RandomStream& stream)
{
    return std::visit(
        [&]<typename Law>(const Law& one) {
            return Judge{JudgeOf<Law>{one, stream}};
        },
        law);
}

LossJudgement LossProcess::on_packet(const Packet& packet)
{
    return std::visit([&](auto& judge) { return judge.on_packet(packet, stream_); }, judge_);
}

void LossProcess::change(const LossLaw& law)
{
    std::visit(
        [&]<typename Law>(const Law& one) {
            if (auto* judge = std::get_if<JudgeOf<Law>>(&judge_)) {
                judge->change(one, stream_);
            } else {
                judge_ = JudgeOf<Law>{one, stream_};
            }
        },
        law);
}

} // namespace hapnet::emulator

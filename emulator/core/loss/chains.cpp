// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/loss/chains.hpp"

#include "proto/base/ensure.hpp"

#include <cstdint>

namespace hapnet::emulator {

namespace {

// The draws for one number.
constexpr std::uint32_t judging = 0;
constexpr std::uint32_t stepping = 1;
constexpr std::uint32_t beginning_draw = 2;

bool begins_bad(const TwoStateSteps& steps, const base::RandomStream& stream)
{
    return stream.uniform(0, beginning_draw) < steps.bad_share();
}

bool is_bad_after(bool is_bad, const TwoStateSteps& steps, double u)
{
    return is_bad ? u >= steps.bad_to_good : u < steps.good_to_bad;
}

LossJudgement judged(bool is_bad, const TwoStateSteps& steps, double u)
{
    auto result =
        judgement(u < (is_bad ? steps.loss_bad : steps.loss_good), DropCause::gilbert_elliott);
    result.state = is_bad ? LossState::bad : LossState::good;
    return result;
}

LossState four_state_beginning(const FourStateSteps& steps, double u)
{
    const auto shares = steps.shares();
    if (u < shares.received_in_gap) return LossState::received_in_gap;
    u -= shares.received_in_gap;
    if (u < shares.lost_in_burst) return LossState::lost_in_burst;
    u -= shares.lost_in_burst;
    return u < shares.received_in_burst ? LossState::received_in_burst : LossState::lost_in_gap;
}

} // namespace

TwoStateJudge::TwoStateJudge(const Gilbert& law, const base::RandomStream& stream)
    : steps_{steps_of(law)}, is_bad_{begins_bad(steps_, stream)}
{}

TwoStateJudge::TwoStateJudge(const GilbertElliott& law, const base::RandomStream& stream)
    : steps_{steps_of(law)}, is_bad_{begins_bad(steps_, stream)}
{}

LossJudgement TwoStateJudge::on_packet(const Packet& packet, const base::RandomStream& stream)
{
    const auto result = judged(is_bad_, steps_, stream.uniform(packet.number, judging));
    is_bad_ = is_bad_after(is_bad_, steps_, stream.uniform(packet.number, stepping));
    return result;
}

TimedTwoStateJudge::TimedTwoStateJudge(const TimedGilbertElliott& law,
                                       const base::RandomStream& stream)
    : law_{law}, is_bad_{begins_bad(steps_of(law, law.mean_good), stream)}
{
    change(law, stream);
}

LossJudgement TimedTwoStateJudge::on_packet(const Packet& packet, const base::RandomStream& stream)
{
    const auto passed = packet.at - last_.value_or(packet.at);
    last_ = packet.at;
    const auto steps = steps_of(law_, passed);
    is_bad_ = is_bad_after(is_bad_, steps, stream.uniform(packet.number, stepping));
    return judged(is_bad_, steps, stream.uniform(packet.number, judging));
}

void TimedTwoStateJudge::change(const TimedGilbertElliott& law, const base::RandomStream&)
{
    base::ensure(law.mean_good > base::Duration{0} && law.mean_bad > base::Duration{0});
    law_ = law;
}

FourStateJudge::FourStateJudge(const FourState& law, const base::RandomStream& stream)
    : steps_{steps_of(law)}, state_{four_state_beginning(steps_, stream.uniform(0, beginning_draw))}
{}

LossJudgement FourStateJudge::on_packet(const Packet& packet, const base::RandomStream& stream)
{
    state_ = step(stream.uniform(packet.number, stepping));
    const bool is_lost = state_ == LossState::lost_in_burst || state_ == LossState::lost_in_gap;
    auto result = judgement(is_lost, DropCause::four_state);
    result.state = state_;
    return result;
}

LossState FourStateJudge::step(double u) const
{
    switch (state_) {
    case LossState::received_in_burst:
        return u < steps_.good_run_to_burst ? LossState::lost_in_burst : state_;
    case LossState::lost_in_burst:
        if (u < steps_.burst_to_gap) return LossState::received_in_gap;
        u -= steps_.burst_to_gap;
        return u < steps_.burst_to_good_run ? LossState::received_in_burst : state_;
    case LossState::lost_in_gap: return LossState::received_in_gap;
    default:
        if (u < steps_.gap_to_burst) return LossState::lost_in_burst;
        u -= steps_.gap_to_burst;
        return u < steps_.gap_to_isolated ? LossState::lost_in_gap : LossState::received_in_gap;
    }
}

} // namespace hapnet::emulator

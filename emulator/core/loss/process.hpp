// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/bursts.hpp"
#include "emulator/core/loss/chains.hpp"
#include "emulator/core/loss/counted.hpp"
#include "emulator/core/loss/judgement.hpp"
#include "emulator/core/loss/law.hpp"
#include "emulator/core/loss/recorded.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"

#include <string_view>
#include <variant>

namespace hapnet::emulator {

/// "random", "k-of-n", ...: the name of a law in profiles and in the name of its stream.
[[nodiscard]] std::string_view name_of(const LossLaw& law);

/// Judges one datagram after the other by one law of loss. What it says of datagram n is a function
/// of the stream, of n, and for laws with a state or in time of the datagrams before. Judging
/// allocates nothing. The law has to be one that validated() accepts.
class LossProcess {
public:
    LossProcess(const LossLaw& law, const base::RandomStream& stream);

    /// Every datagram of the direction is shown here once, in the order of their numbers.
    [[nodiscard]] LossJudgement on_packet(const Packet& packet);

    /// Holds from the next datagram on. A law of the same kind goes on from its state.
    void change(const LossLaw& law);

private:
    using Judge = std::variant<RandomJudge, BlockJudge, PeriodicJudge, BurstJudge, TimedBurstJudge,
                               TwoStateJudge, TimedTwoStateJudge, FourStateJudge, ListJudge,
                               PatternJudge, TraceJudge, OutageJudge>;
    [[nodiscard]] static Judge judge_of(const LossLaw& law, const base::RandomStream& stream);

    base::RandomStream stream_;
    Judge judge_;
};

} // namespace hapnet::emulator

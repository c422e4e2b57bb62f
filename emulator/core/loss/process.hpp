// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/law.hpp"
#include "emulator/core/packet.hpp"
#include "emulator/core/verdict.hpp"
#include "proto/base/random.hpp"

#include <optional>
#include <string_view>

namespace hapnet::emulator {

/// "random": the name of a law in profiles and in the name of its stream.
[[nodiscard]] std::string_view name_of(const LossLaw& law);

/// What a law of loss says of one datagram.
struct LossJudgement {
    std::optional<DropCause> cause; // nullopt: it passes
    LossState state = LossState::none;
};

/// Judges one datagram after the other by one law of loss.
class LossProcess {
public:
    LossProcess(const LossLaw& law, const base::RandomStream& stream);

    /// Every datagram of the direction is shown here once, in the order of their numbers.
    [[nodiscard]] LossJudgement on_packet(const Packet& packet);

    /// Holds from the next datagram on. A law of the same kind goes on from its state.
    void change(const LossLaw& law);

private:
    LossLaw law_;
    base::RandomStream stream_;
};

} // namespace hapnet::emulator

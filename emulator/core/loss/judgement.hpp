// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/verdict.hpp"

#include <optional>

namespace hapnet::emulator {

/// What a law of loss says of one datagram.
struct LossJudgement {
    std::optional<DropCause> cause{}; // nullopt: it passes
    LossState state = LossState::none;

    friend bool operator==(const LossJudgement&, const LossJudgement&) = default;
};

/// That of a law without states.
[[nodiscard]] inline LossJudgement judgement(bool is_lost, DropCause cause)
{
    return is_lost ? LossJudgement{cause} : LossJudgement{};
}

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fate.hpp"
#include "emulator/core/loss/loss.hpp"
#include "emulator/tools/verify/result.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::emulator::tools {

/// The losses of a direction. Entry n is that of datagram n.
struct LossRecord {
    std::vector<std::uint8_t> lost;             // 1: lost
    std::vector<std::vector<LossState>> states; // for each law, the states of all datagrams
    bool is_hidden = false; // some datagrams were dropped before the laws of loss
};
[[nodiscard]] LossRecord loss_record(std::span<const Fate> fates, std::size_t laws);

/// Returns one test for each property of a law. `states` are those of the law.
[[nodiscard]] std::vector<TestResult> verify_properties(const std::vector<LossProperty>& properties,
                                                        std::span<const std::uint8_t> lost,
                                                        std::span<const LossState> states,
                                                        double alpha);

/// Returns the tests that apply to the losses of a direction under its laws. If several laws act
/// together, only their common share of losses and the steps of each chain can be tested.
[[nodiscard]] std::vector<TestResult> verify_losses(const std::vector<LossLaw>& laws,
                                                    const LossRecord& record,
                                                    std::optional<base::Duration> spacing,
                                                    double alpha);

} // namespace hapnet::emulator::tools

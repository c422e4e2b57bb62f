// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/verdict.hpp"
#include "emulator/tools/verify/result.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::emulator {

/// What is known of the losses of a direction: entry n is that of datagram n.
struct LossRecord {
    std::vector<std::uint8_t> lost;             // 1: lost
    std::vector<std::vector<LossState>> states; // of each law
    bool is_hidden = false; // datagrams were dropped before the laws of loss could take them
};
[[nodiscard]] LossRecord loss_record(std::span<const Fate> fates, std::size_t laws);

/// The tests that apply to the losses of a direction under its laws. Where several laws act
/// together only the share that they lose, and the steps of each chain, can be told.
[[nodiscard]] std::vector<TestResult> verify_losses(const std::vector<LossLaw>& laws,
                                                    const LossRecord& record,
                                                    std::optional<base::Duration> spacing,
                                                    double alpha);

/// Whether what the law loses depends on when datagrams come.
[[nodiscard]] bool is_in_time(const LossLaw& law);

/// The correlation of a loss with the next one as one number that is not too small; nullopt for
/// laws that draw nothing, or a phase alone.
[[nodiscard]] std::optional<double> memory_of(const LossLaw& law,
                                              std::optional<base::Duration> spacing);

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/fate.hpp"
#include "emulator/tools/verify/result.hpp"
#include "proto/base/time.hpp"

#include <optional>
#include <span>
#include <vector>

namespace hapnet::emulator::tools {

/// The tests that apply to the delays that were drawn: a constant one exactly, others against as
/// many draws of another seed, and neighbours against their correlation. Correlated delays need the
/// spacing; of those, only some that lie far enough apart are compared.
[[nodiscard]] std::vector<TestResult> verify_delays(const Conditions& conditions,
                                                    std::span<const Fate> fates,
                                                    std::optional<base::Duration> spacing,
                                                    double alpha);

} // namespace hapnet::emulator::tools

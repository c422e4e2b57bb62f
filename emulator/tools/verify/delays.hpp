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

/// Returns the tests that apply to the drawn delays. A constant one is tested exactly. Others are
/// compared with as many draws of another seed, and neighbours with their correlation. Correlated
/// delays need the spacing; only some of them that are far enough apart are compared.
[[nodiscard]] std::vector<TestResult> verify_delays(const Conditions& conditions,
                                                    std::span<const Fate> fates,
                                                    std::optional<base::Duration> spacing,
                                                    double alpha);

} // namespace hapnet::emulator::tools

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/law.hpp"
#include "proto/base/result.hpp"

namespace hapnet::emulator {

/// The law itself when it can be done. Otherwise the error says what is impossible about it and
/// what would be right, in the units that a person writes, without naming the law or the place.
[[nodiscard]] base::Result<LossLaw> validated(LossLaw law);

} // namespace hapnet::emulator

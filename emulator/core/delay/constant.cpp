// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/constant.hpp"

namespace hapnet::emulator {

base::Result<void> ConstantLaw::validate() const
{
    return all({require(value >= base::Duration{0},
                        "a delay cannot be negative: nothing leaves before it arrives"),
                require_ranges(*this)});
}

LawMoments ConstantLaw::moments() const { return {value, base::Duration{0}}; }

} // namespace hapnet::emulator

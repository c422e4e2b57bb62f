// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/law.hpp"

namespace hapnet::emulator {

bool operator==(const TableLaw& a, const TableLaw& b)
{
    return a.file == b.file && a.mean == b.mean && a.sd == b.sd && a.table == b.table;
}

bool operator==(const TraceLaw& a, const TraceLaw& b)
{
    return a.file == b.file && a.trace == b.trace;
}

bool is_nothing(const Variation& variation)
{
    if (const auto* constant = std::get_if<ConstantLaw>(&variation.law)) {
        return constant->value == base::Duration{0};
    }
    if (const auto* uniform = std::get_if<UniformLaw>(&variation.law)) {
        return uniform->mean == base::Duration{0} && uniform->half_width == base::Duration{0};
    }
    return false;
}

} // namespace hapnet::emulator

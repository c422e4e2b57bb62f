// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/delay/bounds.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::emulator {

base::Duration bounded(double nanoseconds)
{
    constexpr auto most = static_cast<double>(longest_delay.count());
    return base::Duration{std::llround(std::clamp(nanoseconds, -most, most))};
}

base::Duration rounded(double nanoseconds) { return base::Duration{std::llround(nanoseconds)}; }

base::Result<void> require(bool condition, std::string_view words)
{
    if (condition) return {};
    return base::fail(std::string{words});
}

base::Result<void> all(std::initializer_list<base::Result<void>> results)
{
    for (const auto& result : results) {
        if (!result) return result;
    }
    return {};
}

} // namespace hapnet::emulator

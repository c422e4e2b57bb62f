// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/verdict.hpp"

#include <chrono>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

std::vector<std::string> invalid_because(const Statistics& statistics, std::uint64_t overflowed,
                                         base::Duration budget)
{
    using Microseconds = std::chrono::duration<double, std::micro>;
    std::vector<std::string> reasons;
    if (!statistics.is_punctual(budget)) {
        reasons.push_back(fmt::format("p99 {:.0f} us is above the budget of {:.0f} us",
                                      Microseconds{*statistics.lateness.quantile(0.99)}.count(),
                                      Microseconds{budget}.count()));
    }
    const auto add = [&](std::string_view cause, std::uint64_t count) {
        if (count > 0) reasons.push_back(fmt::format("the emulator lost {} as {}", count, cause));
    };
    for (const DropCause cause : own_losses) add(to_text(cause), statistics.dropped[cause]);
    add("overflowed", overflowed);
    return reasons;
}

} // namespace hapnet::emulator

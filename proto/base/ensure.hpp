// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <cstdlib>
#include <source_location>

namespace hapnet::base {

/// Stops the program where our own code is wrong; on in every build. Never for their data.
constexpr void ensure(bool condition,
                      const std::source_location where = std::source_location::current())
{
    if (condition) [[likely]]
        return;
    std::fprintf(stderr, "%s:%u: %s: this must never happen; please report it\n", where.file_name(),
                 where.line(), where.function_name());
    std::abort();
}

} // namespace hapnet::base

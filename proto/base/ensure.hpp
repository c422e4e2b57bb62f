// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <cstdlib>

namespace hapnet::base {

/// Stops the program where our own code is wrong; on in every build. Never for their data. The
/// place is found by builtins: Clang 14 has no std::source_location with this library.
constexpr void ensure(bool condition, const char* file = __builtin_FILE(),
                      int line = __builtin_LINE(), const char* function = __builtin_FUNCTION())
{
    if (condition) [[likely]]
        return;
    std::fprintf(stderr, "%s:%d: %s: this must never happen; please report it\n", file, line,
                 function);
    std::abort();
}

} // namespace hapnet::base

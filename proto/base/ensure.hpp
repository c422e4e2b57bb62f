// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <cstdlib>

namespace hapnet::base {

/// Ends the program if `condition` is false, in every build. It is for errors in this project's own
/// code, never for input. Builtins give the place, because Clang 14 has no std::source_location
/// with this library.
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

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hapnet::test {

#ifdef HAPNET_SANITIZED
inline constexpr bool is_sanitized = true;
#else
inline constexpr bool is_sanitized = false;
#endif

/// The number of seeds for a test that plays each in the same way: `all`, or a sixteenth under
/// sanitizers, which take many times as long.
constexpr std::uint64_t seeds(std::uint64_t all) { return is_sanitized ? all / 16 + 1 : all; }

} // namespace hapnet::test

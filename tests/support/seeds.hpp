// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hapnet::test {

/// So many seeds of a test that plays each in the same way: under sanitizers, where each takes
/// many times as long, an eighth of them.
constexpr std::uint64_t seeds(std::uint64_t all)
{
#ifdef HAPNET_SANITIZED
    return all / 8 + 1;
#else
    return all;
#endif
}

} // namespace hapnet::test

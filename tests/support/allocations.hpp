// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hapnet::test {

/// The number of memory allocations by new in this program so far. Linking it replaces the global
/// operator new. Under a sanitizer it counts malloc(), too.
[[nodiscard]] std::uint64_t allocations();

} // namespace hapnet::test

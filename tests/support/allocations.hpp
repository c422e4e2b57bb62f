// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hapnet::test {

/// The number of times that this program has taken memory with new so far. Linking it replaces the
/// global operator new; under a sanitizer it counts malloc(), too.
[[nodiscard]] std::uint64_t allocations();

} // namespace hapnet::test

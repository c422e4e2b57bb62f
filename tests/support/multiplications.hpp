// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace hapnet::test {

/// The number of this program's multiplications on the handshakes' curve so far. Linking it
/// replaces libsodium's crypto_scalarmult() and crypto_scalarmult_base(), which are all that
/// proto/secure/primitives.cpp calls for that.
[[nodiscard]] std::uint64_t multiplications();

} // namespace hapnet::test

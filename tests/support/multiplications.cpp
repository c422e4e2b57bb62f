// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/multiplications.hpp"

#include <atomic>
#include <sodium.h>

namespace {

std::atomic<std::uint64_t> multiplied{0};

} // namespace

// Count, and do the same as the two functions of libsodium.
extern "C" int crypto_scalarmult(unsigned char* product, const unsigned char* number,
                                 const unsigned char* point)
{
    multiplied.fetch_add(1, std::memory_order_relaxed);
    return crypto_scalarmult_curve25519(product, number, point);
}
extern "C" int crypto_scalarmult_base(unsigned char* product, const unsigned char* number)
{
    multiplied.fetch_add(1, std::memory_order_relaxed);
    return crypto_scalarmult_curve25519_base(product, number);
}

namespace hapnet::test {

std::uint64_t multiplications() { return multiplied.load(std::memory_order_relaxed); }

} // namespace hapnet::test

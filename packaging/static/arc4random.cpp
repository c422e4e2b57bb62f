// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// libstdc++'s archive draws at random by a function that the C library has since 2.36.
// With this one in its place the programs also run where that is 2.35.
#include <cstdint>
#include <cstdlib>
#include <sys/random.h>

extern "C" std::uint32_t arc4random() noexcept
{
    std::uint32_t bits = 0;
    while (getrandom(&bits, sizeof bits, 0) != sizeof bits) {} // interrupted
    return bits;
}

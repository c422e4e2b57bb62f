// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/fuzz/fuzz_target.hpp"

/// Must crash: proves that a fuzzer would notice.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    hapnet::base::ensure(!(size >= 2 && data[0] == 'H' && data[1] == 'N'));
    return 0;
}

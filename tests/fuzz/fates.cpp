// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/fates/fates.hpp"
#include "tests/fuzz/fuzz_target.hpp"

/// Text that parse_fates() accepts is written as itself.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    const std::string text{data, data + size};
    const auto fates = emulator::parse_fates(text);
    if (fates) base::ensure(emulator::to_text(*fates) == text);
    return 0;
}

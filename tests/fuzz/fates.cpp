// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/fates/fates.hpp"
#include "tests/fuzz/fuzz_target.hpp"

/// Text that parse_fates() accepts is written as itself; of several paths, in their order.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    const std::string text{data, data + size};
    const auto fates = emulator::parse_fates(text);
    if (fates) base::ensure(emulator::to_text(*fates) == text);
    const auto of_paths = emulator::parse_fates_of_paths(text);
    if (!of_paths) return 0;
    const auto again = emulator::parse_fates_of_paths(emulator::to_text(*of_paths));
    base::ensure(again.has_value() && *again == *of_paths);
    return 0;
}

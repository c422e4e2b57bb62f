// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/text.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <string>

/// An algorithm that is accepted prints as text that reads back as the same algorithm.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    const auto algorithm = peer::parse_algorithm(text, "fuzz");
    if (!algorithm) return 0;
    for (const auto& printed :
         {peer::print_algorithm(*algorithm), peer::explain_algorithm(*algorithm)}) {
        const auto again = peer::parse_algorithm(printed, "printed");
        base::ensure(again.has_value());
        base::ensure(peer::print_algorithm(*again) == peer::print_algorithm(*algorithm));
    }
    return 0;
}

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/text.hpp"
#include "emulator/tools/learn/learn.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <string>

/// A measurement that can be read gives a profile that reads back as itself, unless nothing
/// arrived. Errors name a line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    const auto measurement = emulator::tools::read_measurement(text);
    if (!measurement) {
        base::ensure(measurement.error().message.rfind("line ", 0) == 0);
        return 0;
    }
    constexpr std::size_t most = 1000; // more would be slow
    for (const auto* way : {&measurement->round_trip, &measurement->up, &measurement->down}) {
        if (!*way) continue;
        base::ensure((*way)->delays.size() == (*way)->lost.size());
        if ((*way)->lost.size() > most) return 0;
    }
    const auto lesson = emulator::tools::learn(*measurement);
    if (!lesson) return 0;
    const auto again = emulator::parse_profile(
        emulator::tools::to_text(*lesson), "learned",
        [](const std::string&) { return base::Result<std::string>{base::fail("no file")}; });
    base::ensure(again.has_value());
    base::ensure(*again == lesson->profile);
    return 0;
}

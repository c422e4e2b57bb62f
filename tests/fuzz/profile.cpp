// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/text.hpp"
#include "emulator/core/profile/timeline.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <string>
#include <tuple>

/// A profile that is accepted prints as text that reads back as the same profile, and can be
/// played; and no value of a setting does harm.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    const emulator::OpenFile open = [](const std::string& name) -> base::Result<std::string> {
        if (name == "x.dist") return "0 1 2 3";
        if (name == "x.up") return "1\n3\n";
        if (name == "x.csv") return "t_ms,delay_ms,loss,rate_bps\n0,1,0.5,1000\n5,,1,0\n";
        return "1ms\n2ms\n";
    };
    for (const std::string_view key : emulator::setting_keys) {
        std::ignore = emulator::parse_setting(key, text, open);
    }
    const auto profile = emulator::parse_profile(text, "fuzz", open);
    if (!profile) return 0;
    const auto printed = emulator::to_text(*profile);
    const auto again = emulator::parse_profile(printed, "printed", open);
    base::ensure(again.has_value());
    base::ensure(*again == *profile);
    const emulator::Timeline timeline{*profile};
    auto next = timeline.next_change(base::Duration{-1});
    for (int i = 0; next && i < 10; ++i) {
        std::ignore = timeline.at(*next);
        next = timeline.next_change(*next);
    }
    return 0;
}

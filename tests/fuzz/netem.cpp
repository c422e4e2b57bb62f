// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/netem.hpp"
#include "emulator/core/profile/text.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <string>

/// A sentence that is accepted becomes conditions that a profile can hold.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    const auto netem = hapnet::emulator::tools::parse_netem(text);
    if (!netem) return 0;
    emulator::Profile profile;
    profile.path = {netem->conditions, {}};
    const auto again = emulator::parse_profile(emulator::to_text(profile), "printed", {});
    base::ensure(again.has_value());
    base::ensure(again->path == profile.path);
    return 0;
}

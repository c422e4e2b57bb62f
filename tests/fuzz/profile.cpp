// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/path_name.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/core/profile/timeline.hpp"
#include "emulator/typed_link.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <string>
#include <tuple>
#include <vector>

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
    const auto key = emulator::parse_setting(text, "0", open, {.any = true});
    const auto way = emulator::parse_way(text);
    if (way && !way->path.empty() && way->direction) {
        base::ensure(emulator::parse_way(emulator::way_name(way->path, *way->direction)) == way);
    }
    base::ensure(!key || emulator::PathNames{.any = true}.contains(key->path));
    const auto link = emulator::parse_link(text);
    base::ensure(!link || emulator::parse_link_name(link->name).has_value());
    const auto profile = emulator::parse_profile(text, "fuzz", open);
    if (!profile) return 0;
    const auto printed = emulator::to_text(*profile);
    const auto again = emulator::parse_profile(printed, "printed", open);
    base::ensure(again.has_value());
    base::ensure(*again == *profile);
    std::vector<emulator::NamedProfile> each;
    for (const std::string& path : emulator::paths_in(*profile)) {
        each.push_back({path, emulator::profile_of(*profile, path)});
    }
    const auto joined = emulator::joined(each, profile->flows);
    for (const auto& [path, own] : each) {
        base::ensure(emulator::profile_of(joined, path).path == own.path);
    }
    const emulator::Timeline timeline{*profile};
    auto next = timeline.next_change(base::Duration{-1});
    for (int i = 0; next && i < 10; ++i) {
        std::ignore = timeline.at(*next);
        next = timeline.next_change(*next);
    }
    return 0;
}

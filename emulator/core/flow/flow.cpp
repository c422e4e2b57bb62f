// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/flow/flow.hpp"

#include "proto/base/reading.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

base::Result<void> validate_name(std::string_view name, std::string_view what)
{
    constexpr std::size_t longest = 32;
    constexpr std::array<std::string_view, 7> taken{"up",  "down",        "both",  "flow",
                                                    "all", rest_of_flows, "regime"};
    const auto fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
    };
    if (name.empty() || name.size() > longest || !std::ranges::all_of(name, fits)) {
        return base::fail(fmt::format("{} is not the name of a {}: write 1 to {} characters of "
                                      "a-z, 0-9 and -",
                                      base::in_quotes(name), what, longest));
    }
    if (std::ranges::find(taken, name) == taken.end()) return {};
    return base::fail(
        fmt::format("a {} cannot be called '{}', as that has a meaning in keys", what, name));
}

void FlowNameFormat::read(const base::Node& node, std::string& target, base::Reading& reading) const
{
    std::string name;
    base::read_value(node, name, reading);
    if (!reading.is_good()) return;
    if (const auto valid = validate_flow_name(name); !valid) {
        return reading.complain(node.place, valid.error().message);
    }
    target = std::move(name);
}

void SharedFormat::read(const base::Node& node, bool& target, base::Reading& reading) const
{
    const auto* text = std::get_if<std::string>(&node.value);
    if (text == nullptr || (*text != "shared" && *text != "own")) {
        return base::complain_of(node,
                                 "\"shared\", the rate of the profile; the flow's own rate is "
                                 "written up.rate, down.rate or both.rate",
                                 reading);
    }
    target = *text == "shared";
}

} // namespace hapnet::emulator

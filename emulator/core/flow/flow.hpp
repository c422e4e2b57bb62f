// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/flow/match.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/formats.hpp"
#include "proto/base/result.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace hapnet::emulator {

/// The greatest number of flows in a profile.
inline constexpr std::size_t flows_max = 16;

/// The name of the traffic that belongs to no flow.
inline constexpr std::string_view rest_of_flows = "rest";

/// Refuses a name that has other characters than a-z, 0-9 and '-', or that keys of profiles use.
/// `what` is the kind of the named thing in the error: "flow".
[[nodiscard]] base::Result<void> validate_name(std::string_view name, std::string_view what);
[[nodiscard]] inline base::Result<void> validate_flow_name(std::string_view name)
{
    return validate_name(name, "flow");
}

struct FlowNameFormat {
    void read(const base::Node& node, std::string& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const std::string& value) const { return base::quoted(value); }
    [[nodiscard]] std::string describe() const { return "a name of a-z, 0-9 and -"; }
};

/// Notation: "shared" for true, "own" for false.
struct SharedFormat {
    void read(const base::Node& node, bool& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(bool value) const { return value ? "\"shared\"" : "\"own\""; }
    [[nodiscard]] std::string describe() const { return "\"shared\" or \"own\""; }
};

/// Traffic with conditions of its own: its name, the packets that belong to it, and its treatment.
/// Its conditions are those of the path flow_path("", name); see path_name.hpp.
struct Flow {
    std::string name;
    Match match;
    bool passes = false;      // its packets pass untouched
    bool shares_rate = false; // goes through the bottleneck and the queue of the rest

    friend bool operator==(const Flow&, const Flow&) = default;
};
constexpr auto fields_of(base::Tag<Flow>)
{
    return base::fields(
        "flow",
        base::field("name", &Flow::name, FlowNameFormat{}, "what keys and statistics call it")
            .required(),
        base::field("match", &Flow::match, base::Table{}, "the packets that belong to it")
            .required(),
        base::field("pass", &Flow::passes, "its packets pass untouched, whatever their size"),
        base::field("rate", &Flow::shares_rate, SharedFormat{},
                    "it goes through the rate and the queue of the rest"));
}

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/emulation.hpp"
#include "emulator/control/reply.hpp"
#include "emulator/core/director.hpp"
#include "emulator/core/profile/text.hpp"
#include "proto/control/core/conversation.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

using control::Conversation;

/// The part of an emulator that its control sees.
struct EmulationFake {
    /// `names`: the names of its paths.
    explicit EmulationFake(std::string_view toml, base::TimePoint start,
                           const std::vector<std::string>& names = {""},
                           bool takes_newcomers = false)
        : paths{
              parse_profile(toml, "fake.toml", no_files).value(),
              {.start = start, .limits = {.datagrams_max = 16}, .takes_newcomers = takes_newcomers}}
    {
        for (const std::string& name : names) paths.add(name);
    }

    static base::Result<std::string> no_files(const std::string& name)
    {
        return base::fail("no file " + name);
    }

    /// Returns the first path.
    [[nodiscard]] EmulatedPath& path() const { return *paths.all().front().path; }
    [[nodiscard]] const Director& director() const { return path().director(); }

    static base::Result<std::string> preset(const std::string& name)
    {
        if (name == "slow") return "both.delay = \"700ms\"\n";
        return base::fail("no preset " + name);
    }

    /// Returns the delay of datagrams that arrive now.
    [[nodiscard]] DelayLaw delay(Direction direction) const
    {
        return path().link(direction).conditions().delay.law;
    }

    Paths paths;
    bool is_stopped = false;
    nlohmann::ordered_json statistics{
        {"up", {{"received", 0}, {"lateness_us", {{"p50", nullptr}}}}},
        {"down", {{"received", 0}}},
        {"program", "fake"},
        {"valid", true}};
    Emulation emulation{.paths = paths,
                        .statistics = [this](const control::DoWork&) { return statistics; },
                        .stop = [this] { is_stopped = true; },
                        .preset = [](const std::string& name) { return preset(name); }};
    control::Subject subject = subject_of(emulation);
};

/// Takes the conversation's output.
inline std::string said_by(Conversation& conversation, base::TimePoint now)
{
    std::string said{conversation.output()};
    conversation.on_written(said.size(), now);
    return said;
}

/// Returns all immediate output for `text`.
inline std::string said_to(Conversation& conversation, std::string_view text, EmulationFake& fake,
                           base::TimePoint now)
{
    conversation.on_bytes(text);
    std::string said;
    while (conversation.advance(fake.subject, now)) said += said_by(conversation, now);
    return said + said_by(conversation, now);
}

} // namespace hapnet::emulator

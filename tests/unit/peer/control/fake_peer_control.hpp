// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/control/answer.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>

namespace hapnet::peer {

/// A peer without a loop: only the part that clients see.
struct FakePeerControl {
    nlohmann::ordered_json statistics{{"program", "hapnet-peer"},
                                      {"tick", {{"count", 5}, {"late_us", {{"p99", nullptr}}}}},
                                      {"valid", true},
                                      {"elapsed_s", 2.5}};
    nlohmann::ordered_json shown{{"program", "hapnet-peer"}, {"state", "running"}};
    int stops = 0;
    int emergency_stops = 0;
    nlohmann::ordered_json scene{{"name", "paper"}, {"bodies", nlohmann::json::array()}};
    int frames = 0;   // that were made
    std::string kept; // what was to be saved last
    base::TimePoint kept_from{};
    control::Subject subject =
        subject_of({.show = [this] { return shown; },
                    .statistics = [this] { return statistics; },
                    .stop = [this] { ++stops; },
                    .stop_in_emergency = [this] { ++emergency_stops; },
                    .scene = [this] { return scene; },
                    .frames = [this] { return frame_source(); },
                    .held = std::chrono::seconds{20},
                    .keep = [this](const std::string& name,
                                   base::TimePoint from) -> base::Result<std::string> {
                        kept = name;
                        kept_from = from;
                        if (name == "full") return base::fail("it is full");
                        return "/there/" + name + ".rec";
                    }});

    control::FrameSource frame_source()
    {
        return [this](std::string& text, std::uint64_t left_out) {
            text +=
                nlohmann::ordered_json{{"ok", true}, {"frame", ++frames}, {"left_out", left_out}}
                    .dump();
        };
    }
};

} // namespace hapnet::peer

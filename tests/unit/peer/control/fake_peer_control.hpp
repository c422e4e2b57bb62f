// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/control/answer.hpp"
#include "peer/control/statistics.hpp"
#include "proto/base/fields.hpp"

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::peer {

/// Described statistics of the fake peer.
struct FakeStatistics {
    TickReport tick;
};
constexpr auto fields_of(base::Tag<FakeStatistics>)
{
    return base::fields("fake", base::member("tick", &FakeStatistics::tick));
}

/// A peer without a loop: only the part that clients see.
struct FakePeerControl {
    nlohmann::ordered_json statistics{{"program", "hapnet-peer"},
                                      {"peer_id", 7},
                                      {"tick", {{"count", 5}, {"late_us", {{"p99", nullptr}}}}},
                                      {"valid", true},
                                      {"elapsed_s", 2.5}};
    nlohmann::ordered_json shown{{"program", "hapnet-peer"}, {"state", "running"}};
    int stops = 0;
    int emergency_stops = 0;
    nlohmann::ordered_json scene{{"name", "paper"}, {"bodies", nlohmann::json::array()}};
    int frames = 0;   // number of frames made
    std::string kept; // the last name to save
    base::TimePoint kept_from{};
    std::vector<std::optional<device::HandWish>> hand; // requests to the hand
    PeerControl controls(bool has_page)
    {
        PeerControl peer = own_controls();
        if (has_page) peer.hand = [this](const auto& wish) { hand.push_back(wish); };
        return peer;
    }
    control::Subject subject = subject_of(controls(false));

    PeerControl own_controls()
    {
        return {.show = [this] { return shown; },
                .statistics = [this] { return statistics; },
                .statistics_fields = base::field_table<FakeStatistics>(),
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
                }};
    }
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

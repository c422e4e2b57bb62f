// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/control/answer.hpp"

#include <nlohmann/json.hpp>

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
    control::Subject subject = subject_of({.show = [this] { return shown; },
                                           .statistics = [this] { return statistics; },
                                           .stop = [this] { ++stops; },
                                           .stop_in_emergency = [this] { ++emergency_stops; }});
};

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::web {

/// The time of an event, on the server's own timeline and in calendar time.
struct Moment {
    double at_s = 0.0;
    std::int64_t unix_ms = 0;
};

/// An event that the log of the page shows to people.
struct Event {
    Moment at;
    std::string kind; // "conditions", "peer", ...: docs/formats/live.md
    std::string text;
    std::int64_t generation = 0; // generation of the conditions; 0: none
    std::vector<std::string> files{};
    nlohmann::ordered_json set = nullptr; // the requested settings
};

/// The newest events, numbered from 1.
class Events {
public:
    static constexpr std::size_t kept_max = 100;

    /// Adds an event. Returns it in the form for the page: {"type":"event","id":..}.
    const nlohmann::ordered_json& add(const Event& event);

    [[nodiscard]] const std::deque<nlohmann::ordered_json>& kept() const { return kept_; }

private:
    std::int64_t count_ = 0;
    std::deque<nlohmann::ordered_json> kept_;
};

} // namespace hapnet::web

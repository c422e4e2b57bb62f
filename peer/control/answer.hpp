// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/page/page_hand.hpp"
#include "proto/base/field_table.hpp"
#include "proto/control/core/conversation.hpp"

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::peer {

/// A running peer as the clients of its control socket see it. They read its status, and may stop
/// it or save its recent rows. The functions are called from the thread that serves the clients,
/// never from the loop's.
struct PeerControl {
    std::function<nlohmann::ordered_json()> show; // returns the status as a JSON object
    std::function<nlohmann::ordered_json()> statistics;
    /// Describes the statistics, with the names of metrics.
    const base::FieldTable& statistics_fields;
    /// Requests a stop, like SIGTERM.
    std::function<void()> stop;
    /// Commands zero force until the program is started again. The session continues without force.
    std::function<void()> stop_in_emergency;
    /// Returns a JSON object that describes the scene to programs that draw it.
    std::function<nlohmann::ordered_json()> scene;
    /// Begins a watch of frames.
    std::function<control::FrameSource()> frames;
    /// The time span of the recent rows in memory; nullopt: none are kept.
    std::optional<base::Duration> held{};
    /// Orders a record of the kept rows since `from` and returns its path.
    std::function<base::Result<std::string>(const std::string& name, base::TimePoint from)> keep{};
    /// Moves or releases the hand of a page. null: this peer has another device.
    std::function<void(const std::optional<device::HandWish>& wish)> hand{};
};

/// Returns the answer to a request line; docs/formats/control.md describes the requests. Requests
/// that would change the peer are refused, except those that move the hand of a page.
[[nodiscard]] control::Answer answer_to(std::string_view line, const PeerControl& peer,
                                        base::TimePoint now);

/// Returns the peer in the form that a control socket needs.
[[nodiscard]] control::Subject subject_of(PeerControl peer);

} // namespace hapnet::peer

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

/// A running peer as the clients of its control socket see it: they read its status, and may stop
/// it or save what it holds. Called from the thread that serves them, never from the loop's.
struct PeerControl {
    std::function<nlohmann::ordered_json()> show; // gives the status as a JSON object
    std::function<nlohmann::ordered_json()> statistics;
    /// Describes the statistics, with the names of metrics.
    const base::FieldTable& statistics_fields;
    /// Asks for a stop, as SIGTERM does.
    std::function<void()> stop;
    /// Commands zero force until the program is started again; the session goes on without force.
    std::function<void()> stop_in_emergency;
    /// Describes the scene to programs that draw it; an object.
    std::function<nlohmann::ordered_json()> scene;
    /// Begins a watch of frames.
    std::function<control::FrameSource()> frames;
    /// The time span of the last rows that memory holds; nullopt: none.
    std::optional<base::Duration> held{};
    /// Orders a record of the held rows since a time; gives its path.
    std::function<base::Result<std::string>(const std::string& name, base::TimePoint from)> keep{};
    /// Moves or releases the hand of a page; null: this peer has another device.
    std::function<void(const std::optional<device::HandWish>& wish)> hand{};
};

/// The answer to a request line; docs/formats/control.md describes the requests. A request that
/// would change the peer is refused, except one that moves the hand of a page.
[[nodiscard]] control::Answer answer_to(std::string_view line, const PeerControl& peer,
                                        base::TimePoint now);

/// The peer for a control socket.
[[nodiscard]] control::Subject subject_of(PeerControl peer);

} // namespace hapnet::peer

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
    std::function<nlohmann::ordered_json()> show; // an object
    std::function<nlohmann::ordered_json()> statistics;
    /// What describes the statistics, with the names of metrics.
    const base::FieldTable& statistics_fields;
    /// As SIGTERM does.
    std::function<void()> stop;
    /// Zero force from now on, until the program is started anew; the session goes on without.
    std::function<void()> stop_in_emergency;
    /// What is in the scene, for whoever draws it; an object.
    std::function<nlohmann::ordered_json()> scene;
    /// Begins a watch of frames.
    std::function<control::FrameSource()> frames;
    /// How much of the last rows is held in memory; nullopt: none.
    std::optional<base::Duration> held{};
    /// Orders a record of them since a time; gives its path.
    std::function<base::Result<std::string>(const std::string& name, base::TimePoint from)> keep{};
    /// Tells the hand of a page what to do, or lets it go; null: this peer has another device.
    std::function<void(const std::optional<device::HandWish>& wish)> hand{};
};

/// The answer to a request line; docs/formats/control.md describes the requests. A request that
/// would change the peer is refused, but for one that moves the hand of a page.
[[nodiscard]] control::Answer answer_to(std::string_view line, const PeerControl& peer,
                                        base::TimePoint now);

/// The peer for a control socket.
[[nodiscard]] control::Subject subject_of(PeerControl peer);

} // namespace hapnet::peer

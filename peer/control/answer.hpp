// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/control/core/conversation.hpp"

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace hapnet::peer {

/// A running peer as its clients see it: they ask how it is, and may end it. Called from the
/// thread that serves them, never from the loop's.
struct Attended {
    std::function<nlohmann::ordered_json()> show; // an object
    std::function<nlohmann::ordered_json()> statistics;
    /// As SIGTERM does.
    std::function<void()> stop;
};

/// What becomes of a request; PROTOCOL.md describes them. What would change the peer is refused.
[[nodiscard]] control::Answer answer_to(std::string_view line, const Attended& peer);

/// The peer for a control socket.
[[nodiscard]] control::Subject subject_of(Attended peer);

} // namespace hapnet::peer

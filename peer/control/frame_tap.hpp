// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/control/core/conversation.hpp"
#include "proto/record/rows.hpp"
#include "proto/telemetry/decimator.hpp"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace hapnet::peer {

/// Makes frames for watching clients from the rows of a peer's record. The loop does no work for
/// them. While no client watches it keeps only what the sessions agreed on, a row a second.
class FrameTap {
public:
    explicit FrameTap(std::uint16_t peer_id) : peer_id_{peer_id} {}

    /// Begins a watch; it ends when the source is destroyed. All functions here, and the source,
    /// belong to one thread.
    [[nodiscard]] control::FrameSource watch();

    void take(const record::Row& row);
    /// A message as it came; those of rows, too.
    void hear(std::uint16_t from, base::TimePoint at, std::span<const std::byte> message);

    /// Frames go on from what follows, which may be earlier than what was before.
    void begin_anew();
    /// Frames go on from what follows, in the same sessions: what was left out was not shown.
    void skip();

private:
    using Watch = std::weak_ptr<telemetry::Decimator>;

    /// Calls `visit` with each decimator that is still wanted.
    void for_each_watch(const auto& visit);
    void note(const record::SessionRow& session);

    std::uint16_t peer_id_;
    std::vector<Watch> watches_;
    std::vector<record::SessionRow> sessions_; // newest row with each of the others
};

} // namespace hapnet::peer

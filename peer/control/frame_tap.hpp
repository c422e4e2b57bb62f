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

/// Makes frames for watching clients from the rows of a peer's record, so that the loop does no
/// work for them. While no client watches, it keeps only the terms of the sessions, which are one
/// row a second.
class FrameTap {
public:
    explicit FrameTap(std::uint16_t peer_id) : peer_id_{peer_id} {}

    /// Begins a watch, which ends when the source is destroyed. Only one thread may use the
    /// functions of this class and the source.
    [[nodiscard]] control::FrameSource watch();

    void take(const record::Row& row);
    /// Takes a received message. take() passes the messages of rows to it.
    void hear(std::uint16_t from, base::TimePoint at, std::span<const std::byte> message);

    /// Restarts the frames with the rows that follow, which may be earlier than the previous ones.
    void begin_anew();
    /// Continues the frames after rows that were left out. The sessions are the same as before.
    void skip();

private:
    using Watch = std::weak_ptr<telemetry::Decimator>;

    /// Calls `visit` with each decimator whose watch has not ended.
    void for_each_watch(const auto& visit);
    void note(const record::SessionRow& session);

    std::uint16_t peer_id_;
    std::vector<Watch> watches_;
    std::vector<record::SessionRow> sessions_; // newest row with each of the others
};

} // namespace hapnet::peer

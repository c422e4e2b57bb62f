// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/loop/journal.hpp"
#include "proto/control/core/conversation.hpp"
#include "proto/telemetry/decimator.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace hapnet::peer::monitor {

/// Makes frames for those who watch, from what has left the journal: the loop does nothing for it.
/// While nobody watches it keeps only what the sessions agreed on, a row a second.
class FrameTap {
public:
    explicit FrameTap(std::uint16_t peer_id) : peer_id_{peer_id} {}

    /// Begins a watch; it ends when the source is destroyed. Of this thread, as all here.
    [[nodiscard]] control::FrameSource watch();

    /// What came out of the journal.
    void take(const loop::Entry& entry);

private:
    using Watch = std::weak_ptr<telemetry::Decimator>;

    void note(const record::SessionRow& session);

    std::uint16_t peer_id_;
    std::vector<Watch> watches_;
    std::vector<record::SessionRow> sessions_; // the newest with each of the others
};

} // namespace hapnet::peer::monitor

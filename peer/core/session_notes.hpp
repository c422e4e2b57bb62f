// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/peer.hpp"
#include "proto/record/rows.hpp"

#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

namespace hapnet::peer {

/// The rows of a record with the terms of a peer's session with each of the others. A row is due
/// when they are agreed on, when they change, and once a second, because the clock estimates
/// change.
class SessionNotes {
public:
    static constexpr base::Duration noted_every{std::chrono::seconds{1}};

    /// Calls put(row) for each row that is due. Call it after a tick.
    template <typename Put>
    void after_tick(const Peer& peer, base::TimePoint now, const Put& put)
    {
        noted_.resize(peer.others().size());
        for (std::size_t other = 0; other < noted_.size(); ++other)
            if (is_due(peer, other, now)) put(*noted_[other]);
    }

private:
    [[nodiscard]] bool is_due(const Peer& peer, std::size_t other, base::TimePoint now);

    std::vector<std::optional<record::SessionRow>> noted_; // newest row with each of the others
};

} // namespace hapnet::peer

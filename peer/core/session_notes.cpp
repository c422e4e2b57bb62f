// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/session_notes.hpp"

namespace hapnet::peer {

/// Creates the row and returns true if it is due.
bool SessionNotes::is_due(const Peer& peer, std::size_t other, base::TimePoint now)
{
    const Remote& remote = peer.others()[other];
    const auto& session = remote.session();
    if (!session) return false;
    // The clock of a restarted remote is unknown until the remote has answered.
    const auto clock = remote.handshake().clock();
    if (!clock) return false;
    auto& noted = noted_[other];
    const bool is_new =
        !noted || noted->session != session->number || noted->start != session->start;
    if (!is_new && now - noted->noted_at < noted_every) return false;
    noted = record::SessionRow{.start = session->start,
                               .length = peer.length(),
                               .remote_offset = clock->offset,
                               .offset_uncertainty = clock->uncertainty,
                               .session = session->number,
                               .seed = session->seed,
                               .other = remote.id(),
                               .noted_at = now,
                               .remote_skew_ppm = clock->skew_ppm};
    return true;
}

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/virtual_time/journal.hpp"

namespace hapnet::lab::virtual_time {

Journal::Journal(const VirtualPlayer& player, Sink sink)
    : player_{player},
      sink_{std::move(sink)},
      has_bodies_{!peer::is_one_without_turning(player.peer().shared())}
{}

void Journal::on_message(std::size_t from_seat, const VirtualWorld::Arrival& arrival)
{
    sink_(record::MessageRow{.tick = tick_,
                             .received_at = arrival.at + player_.clock_ahead,
                             .from = static_cast<std::uint16_t>(from_seat + 1),
                             .bytes{arrival.datagram.begin(), arrival.datagram.end()}});
}

void Journal::on_tick()
{
    const base::TimePoint now = player_.stepped_at + player_.clock_ahead;
    sink_(player_.side->row(tick_, {.due = now}));
    if (has_bodies_) {
        for (const peer::SharedBody& body : player_.peer().shared())
            sink_(player_.side->body_row(tick_, body));
    }
    notes_.after_tick(player_.peer(), now, sink_);
    ++tick_;
}

} // namespace hapnet::lab::virtual_time

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/virtual_time/journal.hpp"

#include <chrono>

namespace hapnet::lab::virtual_time {

namespace {

constexpr base::Duration noted_every{std::chrono::seconds{1}}; // what two have agreed on

} // namespace

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
    noted_.resize(player_.peer().others().size());
    for (std::size_t other = 0; other < noted_.size(); ++other) note(other, now);
    ++tick_;
}

void Journal::note(std::size_t other, base::TimePoint now)
{
    const peer::Remote& remote = player_.peer().others()[other];
    const auto& session = remote.session();
    const auto clock = player_.peer().clock(other);
    if (!session || !clock) return;
    auto& noted = noted_[other];
    const bool is_new =
        !noted || noted->session != session->number || noted->start != session->start;
    if (!is_new && now - noted->noted_at < noted_every) return;
    noted = record::SessionRow{.start = session->start,
                               .length = player_.peer().length(),
                               .remote_offset = clock->offset,
                               .offset_uncertainty = clock->uncertainty,
                               .session = session->number,
                               .seed = session->seed,
                               .other = remote.id(),
                               .noted_at = now,
                               .remote_skew_ppm = clock->skew_ppm};
    sink_(*noted);
}

} // namespace hapnet::lab::virtual_time

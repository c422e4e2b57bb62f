// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/virtual_time/world.hpp"

#include <algorithm>

namespace hapnet::lab {

namespace {

using emulator::Direction;

/// The side at the other end.
std::size_t partner_of(std::size_t side) { return side ^ 1U; }

} // namespace

VirtualWorld::VirtualWorld(const Setting& setting, emulator::QueueLimits limits)
    : VirtualWorld{std::span{&setting, 1}, limits}
{}

VirtualWorld::VirtualWorld(std::span<const Setting> settings, emulator::QueueLimits limits)
{
    pairs_.reserve(settings.size());
    seats_.reserve(2 * settings.size());
    for (const Setting& setting : settings) add(setting, limits);
}

void VirtualWorld::add(const Setting& setting, emulator::QueueLimits limits)
{
    pairs_.push_back({setting, emulator::Director{setting.profile, start}});
    const emulator::Path& path = pairs_.back().director.path();
    for (const Direction direction : {Direction::up, Direction::down}) {
        const bool is_up = direction == Direction::up;
        const PlayerSetting& player = setting.players.at(is_up ? 0 : 1);
        seats_.push_back({.player = std::nullopt,
                          .out = emulator::Link{is_up ? path.up : path.down,
                                                {.seed = setting.seed,
                                                 .direction = direction,
                                                 .start = start,
                                                 .limits = limits,
                                                 .has_lens = false}},
                          .undelayed = {},
                          .next_tick = start + setting.tick + player.phase,
                          .tick = setting.tick});
        revive(seats_.size() - 1);
    }
}

void VirtualWorld::revive(std::size_t side)
{
    Pair& pair = pairs_[side / 2];
    seats_[side].player.emplace(pair.setting, Seat{side % 2, pair.next_nonce++});
}

base::TimePoint VirtualWorld::next_deadline() const
{
    base::TimePoint next = seats_.front().next_tick;
    for (const Place& place : seats_) next = std::min(next, place.next_tick);
    for (const Pair& pair : pairs_) {
        if (const auto change = pair.director.next_change()) next = std::min(next, *change);
    }
    return next;
}

void VirtualWorld::step()
{
    now_ = next_deadline();
    for (std::size_t pair = 0; pair < pairs_.size(); ++pair) follow_timeline(pair);
    // What is sent at a tick reaches nobody whose tick is at the same time.
    for (std::size_t side = 0; side < seats_.size(); ++side) {
        if (seats_[side].next_tick == now_) deliver(side);
    }
    for (std::size_t side = 0; side < seats_.size(); ++side) {
        if (seats_[side].next_tick != now_) continue;
        if (seats_[side].player) turn(side);
        seats_[side].next_tick += seats_[side].tick;
    }
}

void VirtualWorld::run_for(base::Duration duration)
{
    const auto end = now_ + duration;
    while (next_deadline() <= end) step();
    now_ = end;
}

void VirtualWorld::follow_timeline(std::size_t pair)
{
    emulator::Director& director = pairs_[pair].director;
    if (!director.advance(now_)) return;
    seats_[2 * pair].out.change(director.path().up, now_);
    seats_[2 * pair + 1].out.change(director.path().down, now_);
}

void VirtualWorld::deliver(std::size_t to)
{
    Place& from = seats_[partner_of(to)];
    auto& receiver = seats_[to].player;
    for (const Passing& passing : from.undelayed) {
        emulator::Departure departure = passing.departure;
        departure.bytes = passing.datagram.bytes();
        if (receiver) receiver->receive(departure.bytes, departure.due);
        from.out.on_sent(departure, departure.due);
    }
    from.undelayed.clear();
    while (const auto departure = from.out.poll(now_)) {
        if (receiver) receiver->receive(departure->bytes, departure->due);
        from.out.on_sent(*departure, departure->due);
    }
}

void VirtualWorld::turn(std::size_t side)
{
    Place& place = seats_[side];
    place.player->turn(now_);
    while (const auto datagram = place.player->peer->poll()) {
        if (pairs_[side / 2].is_cut) continue;
        const auto admission = place.out.on_packet(datagram->bytes(), now_);
        if (admission.departure) place.undelayed.push_back({*admission.departure, *datagram});
    }
}

} // namespace hapnet::lab

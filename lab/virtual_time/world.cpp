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
    sides_.reserve(2 * settings.size());
    for (const Setting& setting : settings) add(setting, limits);
}

void VirtualWorld::add(const Setting& setting, emulator::QueueLimits limits)
{
    pairs_.push_back({setting, emulator::Director{setting.profile, start}});
    const emulator::Path& path = pairs_.back().director.path();
    for (const Direction direction : {Direction::up, Direction::down}) {
        const bool is_up = direction == Direction::up;
        const PlayerSetting& player = setting.players.at(is_up ? 0 : 1);
        sides_.push_back({.player = std::nullopt,
                          .out = emulator::Link{is_up ? path.up : path.down,
                                                {.seed = setting.seed,
                                                 .direction = direction,
                                                 .start = start,
                                                 .limits = limits,
                                                 .has_lens = false}},
                          .undelayed = {},
                          .next_tick = start + setting.tick + player.phase,
                          .tick = setting.tick});
        revive(sides_.size() - 1);
    }
}

void VirtualWorld::revive(std::size_t side)
{
    Pair& pair = pairs_[side / 2];
    sides_[side].player.emplace(pair.setting, PlayerId{side % 2, pair.next_nonce++});
}

base::TimePoint VirtualWorld::next_deadline() const
{
    base::TimePoint next = sides_.front().next_tick;
    for (const Side& side : sides_) next = std::min(next, side.next_tick);
    for (const Pair& pair : pairs_) {
        if (const auto change = pair.director.next_change()) next = std::min(next, *change);
    }
    return next;
}

void VirtualWorld::step()
{
    now_ = next_deadline();
    for (std::size_t pair = 0; pair < pairs_.size(); ++pair) follow_timeline(pair);
    // A datagram that is sent in a tick does not reach a tick at the same time.
    for (std::size_t side = 0; side < sides_.size(); ++side) {
        if (sides_[side].next_tick == now_) deliver(side);
    }
    for (std::size_t side = 0; side < sides_.size(); ++side) {
        if (sides_[side].next_tick != now_) continue;
        if (sides_[side].player) play(side);
        sides_[side].next_tick += sides_[side].tick;
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
    sides_[2 * pair].out.change(director.path().up, now_);
    sides_[2 * pair + 1].out.change(director.path().down, now_);
}

void VirtualWorld::deliver(std::size_t to)
{
    Side& from = sides_[partner_of(to)];
    auto& receiver = sides_[to].player;
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

void VirtualWorld::play(std::size_t side)
{
    Side& here = sides_[side];
    here.player->step(now_);
    while (const auto datagram = here.player->side->poll()) {
        if (pairs_[side / 2].is_cut) continue;
        const auto admission = here.out.on_packet(datagram->bytes(), now_);
        if (admission.departure) here.undelayed.push_back({*admission.departure, *datagram});
    }
}

} // namespace hapnet::lab

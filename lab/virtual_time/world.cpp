// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/virtual_time/world.hpp"

#include <algorithm>

namespace hapnet::lab::virtual_time {

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
    pairs_.push_back({setting, emulator::EmulatedPath{setting.profile,
                                                      {.seed = setting.seed,
                                                       .start = start,
                                                       .limits = limits,
                                                       .has_stream_statistics = false}}});
    for (const PlayerSetting& player : setting.players) {
        sides_.push_back({.player = std::nullopt,
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
        if (const auto change = pair.path.director().next_change()) next = std::min(next, *change);
    }
    return next;
}

void VirtualWorld::step()
{
    now_ = next_deadline();
    for (Pair& pair : pairs_) pair.path.advance(now_);
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

void VirtualWorld::deliver(std::size_t to)
{
    const std::size_t from = partner_of(to);
    const Direction direction = direction_of(from);
    emulator::EmulatedPath& path = pairs_[from / 2].path;
    for (const Passing& passing : sides_[from].undelayed) {
        emulator::Datagram datagram = passing.departure;
        datagram.bytes = passing.datagram.bytes();
        hand_over(to, datagram.bytes, datagram.due);
        path.on_sent(direction, datagram, datagram.due);
    }
    sides_[from].undelayed.clear();
    while (const auto datagram = path.poll(direction, now_)) {
        hand_over(to, datagram->bytes, datagram->due);
        path.on_sent(direction, *datagram, datagram->due);
    }
}

void VirtualWorld::hand_over(std::size_t to, std::span<const std::byte> datagram,
                             base::TimePoint arrived)
{
    if (interceptor_) return interceptor_(to, datagram, arrived);
    if (sides_[to].player) sides_[to].player->receive(datagram, arrived);
}

void VirtualWorld::play(std::size_t side)
{
    Side& here = sides_[side];
    here.player->step(now_);
    const secure::Place other = place_of(partner_of(side));
    here.player->send_all([&](std::span<const std::byte> bytes, const secure::Place& to) {
        if (pairs_[side / 2].is_cut || to != other) return;
        const auto admission = pairs_[side / 2].path.on_packet(direction_of(side), bytes, now_);
        if (admission.departure)
            here.undelayed.push_back({*admission.departure, peer::line::Datagram{bytes}});
    });
}

} // namespace hapnet::lab::virtual_time

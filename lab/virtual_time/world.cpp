// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/virtual_time/world.hpp"

#include <algorithm>
#include <string>
#include <tuple>

namespace hapnet::lab::virtual_time {

VirtualWorld::~VirtualWorld() = default;
VirtualWorld::VirtualWorld(VirtualWorld&&) noexcept = default;
VirtualWorld& VirtualWorld::operator=(VirtualWorld&&) noexcept = default;

VirtualWorld::VirtualWorld(const Setting& setting, emulator::QueueLimits limits)
    : VirtualWorld{std::span{&setting, 1}, limits}
{}

VirtualWorld::VirtualWorld(std::span<const Setting> settings, emulator::QueueLimits limits)
{
    groups_.reserve(settings.size());
    for (const Setting& setting : settings) add(setting, limits);
}

void VirtualWorld::add(const Setting& setting, emulator::QueueLimits limits)
{
    emulator::Paths paths{setting.profile,
                          {.seed = setting.seed,
                           .start = start,
                           .limits = limits,
                           .stream_detail = emulator::StreamDetail::nothing}};
    groups_.push_back({setting, std::move(paths), sides_.size(), setting.players.size()});
    for (const PlayerSetting& player : setting.players) {
        sides_.push_back({.player = std::nullopt,
                          .group = groups_.size() - 1,
                          .next_tick = start + setting.tick + player.phase,
                          .tick = setting.tick,
                          .ticks = player.ticks});
        revive(sides_.size() - 1);
    }
    add_ways(groups_.back());
}

void VirtualWorld::add_ways(Group& group)
{
    for (const std::string& name : links_between(group.size)) std::ignore = group.paths.add(name);
    const auto& paths = group.paths.all();
    const auto path_between = [&](std::size_t low, std::size_t high) {
        // The paths from lower seats come first: size - 1 from the first seat, then one less from
        // each.
        const std::size_t before = low * (2 * group.size - low - 1) / 2;
        return paths[before + high - low - 1].path.get();
    };
    for (std::size_t from = 0; from < group.size; ++from) {
        const std::size_t side = group.first_side + from;
        sides_[side].first_out = ways_.size();
        for (std::size_t to = 0; to < group.size; ++to) {
            if (from == to) continue;
            const bool is_up = from < to;
            sides_[group.first_side + to].ins.push_back(ways_.size());
            ways_.push_back(
                {.path = path_between(std::min(from, to), std::max(from, to)),
                 .direction = is_up ? emulator::Direction::up : emulator::Direction::down,
                 .from = side,
                 .begin = place_of(from),
                 .end = place_of(to),
                 .line = is_up ? from : from - 1});
        }
    }
}

void VirtualWorld::revive(std::size_t side)
{
    Group& group = groups_[sides_[side].group];
    sides_[side].player.emplace(group.setting, PlayerId{seat_of(side), group.next_nonce++});
}

void VirtualWorld::cut(std::size_t a, std::size_t b, bool is_cut)
{
    ways_[way_between(a, b)].is_cut = is_cut;
    ways_[way_between(b, a)].is_cut = is_cut;
}

void VirtualWorld::isolate(std::size_t side, bool is_cut)
{
    const Group& group = groups_[sides_[side].group];
    for (std::size_t other = group.first_side; other < group.first_side + group.size; ++other) {
        if (other != side) cut(side, other, is_cut);
    }
}

base::TimePoint VirtualWorld::next_deadline() const
{
    base::TimePoint next = sides_.front().next_tick;
    for (const Side& side : sides_) next = std::min(next, side.next_tick);
    for (const Group& group : groups_) {
        if (const auto change = group.paths.next_change()) next = std::min(next, *change);
    }
    return next;
}

void VirtualWorld::step()
{
    now_ = next_deadline();
    for (Group& group : groups_) group.paths.advance(now_);
    // A datagram that is sent in a tick does not reach another tick at the same time.
    for (std::size_t side = 0; side < sides_.size(); ++side) {
        if (sides_[side].next_tick == now_) deliver(side);
    }
    for (std::size_t side = 0; side < sides_.size(); ++side) {
        if (sides_[side].next_tick != now_) continue;
        if (sides_[side].player) play(side);
        sides_[side].next_tick = tick_after(sides_[side]);
    }
}

base::TimePoint VirtualWorld::tick_after(Side& side) const
{
    const base::TimePoint even = now_ + side.tick;
    if (!side.ticks || !side.player) return even;
    const auto& session = side.player->peer().session();
    if (!session) return even;
    const auto& ticks = *side.ticks;
    const base::TimePoint begin = session->start - side.player->clock_ahead;
    std::size_t& next = side.ticks_begun;
    while (next < ticks.size() && begin + ticks[next] <= now_) ++next;
    if (next == ticks.size()) return even;
    const base::TimePoint given = begin + ticks[next];
    return next == 0 ? std::min(even, given) : given;
}

void VirtualWorld::run_for(base::Duration duration)
{
    const auto end = now_ + duration;
    while (next_deadline() <= end) step();
    now_ = end;
}

void VirtualWorld::deliver(std::size_t to)
{
    for (const std::size_t index : sides_[to].ins) {
        Way& way = ways_[index];
        for (const Passing& passing : way.undelayed) {
            emulator::Datagram datagram = passing.departure;
            datagram.bytes = passing.datagram.bytes();
            hand_over(to, way, datagram);
            way.path->on_sent(way.direction, datagram, datagram.due);
        }
        way.undelayed.clear();
        while (const auto datagram = way.path->poll(way.direction, now_)) {
            hand_over(to, way, *datagram);
            way.path->on_sent(way.direction, *datagram, datagram->due);
        }
    }
}

void VirtualWorld::hand_over(std::size_t to, const Way& way, const emulator::Datagram& datagram)
{
    if (interceptor_) return interceptor_({way.from, to, datagram.bytes, datagram.due});
    auto& player = sides_[to].player;
    if (player) player->receive(way.line, way.begin, datagram.bytes, datagram.due);
}

void VirtualWorld::play(std::size_t side)
{
    Side& here = sides_[side];
    here.player->step(now_);
    here.player->send_all(
        [&](std::size_t other, std::span<const std::byte> bytes, const secure::Place& to) {
            Way& way = ways_[here.first_out + other];
            if (way.is_cut || !secure::is_same(to, way.end)) return;
            const auto admission = way.path->on_packet(way.direction, bytes, now_);
            if (admission.departure)
                way.undelayed.push_back({*admission.departure, peer::line::Datagram{bytes}});
        });
}

} // namespace hapnet::lab::virtual_time

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/emulated_path.hpp"

#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

/// Returns the conditions of one direction of a path. They share the ownership of the path.
std::shared_ptr<const Conditions> way_of(const std::shared_ptr<const Path>& path,
                                         Direction direction)
{
    return {path, direction == Direction::up ? &path->up : &path->down};
}

Link make_link(const std::shared_ptr<const Path>& path, const EmulatedPath::Setup& setup,
               const std::shared_ptr<Slab>& slab, Direction direction)
{
    const bool is_up = direction == Direction::up;
    Link::Setup link{.seed = setup.seed,
                     .direction = direction,
                     .start = setup.start,
                     .limits = setup.limits,
                     .slab = slab,
                     .stream_detail = setup.stream_detail,
                     .name = setup.name,
                     .place = setup.place};
    if (setup.replay) {
        const auto& fates = is_up ? setup.replay->up : setup.replay->down;
        link.replay.emplace(std::shared_ptr<const std::vector<Fate>>{setup.replay, &fates});
    }
    return Link{way_of(path, direction), link};
}

} // namespace

EmulatedPath::EmulatedPath(Director director, const Setup& setup)
    : EmulatedPath{std::move(director), setup,
                   setup.slab ? setup.slab : std::make_shared<Slab>(setup.limits.bytes_max)}
{}

EmulatedPath::EmulatedPath(Director director, const Setup& setup, const std::shared_ptr<Slab>& slab)
    : director_{std::move(director)},
      place_{setup.place},
      changes_{setup.changes_max},
      enacted_{director_.shared_path()},
      up_{make_link(enacted_, setup, slab, Direction::up)},
      down_{make_link(enacted_, setup, slab, Direction::down)}
{}

base::Result<void> EmulatedPath::apply(const Command& command, base::TimePoint now, ChangeCause by)
{
    advance(now); // logs the changes of the timeline separately
    const auto generation = director_.generation();
    auto done = director_.apply(command, now);
    if (director_.generation() != generation) enact(now, by);
    return done;
}

void EmulatedPath::follow(const Director& director, base::TimePoint now, ChangeCause by)
{
    const auto generation = director_.generation();
    director_ = director;
    if (director_.generation() != generation) enact(now, by);
}

void EmulatedPath::follow(const Director& director, base::TimePoint now)
{
    const auto generation = director_.generation();
    director_ = director;
    if (director_.generation() != generation) enact_timeline(now);
}

void EmulatedPath::enact_timeline(base::TimePoint now)
{
    const bool is_by_hand = director_.last_reason() == Director::Reason::hand;
    enact(now, is_by_hand ? ChangeCause::hand : ChangeCause::timeline);
}

void EmulatedPath::enact(base::TimePoint now, ChangeCause by)
{
    changes_.add({.generation = director_.generation(),
                  .elapsed = director_.elapsed(),
                  .effective_up = up_.statistics().received,
                  .effective_down = down_.statistics().received,
                  .by = by,
                  .from = enacted_,
                  .to = director_.shared_path()},
                 director_.last_reason() == Director::Reason::ramp);
    place_.mark();
    enacted_ = director_.shared_path();
    up_.share(way_of(enacted_, Direction::up), now);
    down_.share(way_of(enacted_, Direction::down), now);
}

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/emulated_path.hpp"

#include "emulator/core/profile/paths.hpp"

#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

Link make_link(const Path& path, const EmulatedPath::Setup& setup,
               const std::shared_ptr<Slab>& slab, Direction direction)
{
    const bool is_up = direction == Direction::up;
    Link::Setup link{.seed = setup.seed,
                     .direction = direction,
                     .start = setup.start,
                     .limits = setup.limits,
                     .slab = slab,
                     .has_stream_statistics = setup.has_stream_statistics,
                     .name = setup.name};
    if (setup.replay) {
        const auto& fates = is_up ? setup.replay->up : setup.replay->down;
        link.replay.emplace(std::shared_ptr<const std::vector<Fate>>{setup.replay, &fates});
    }
    return Link{is_up ? path.up : path.down, link};
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
      up_{make_link(director_.path(), setup, slab, Direction::up)},
      down_{make_link(director_.path(), setup, slab, Direction::down)}
{}

base::Result<void> EmulatedPath::apply(const Command& command, base::TimePoint now, ChangeCause by)
{
    advance(now); // what the timeline changes is its own
    const auto generation = director_.generation();
    auto done = director_.apply(command, now);
    if (director_.generation() != generation) enact(now, by);
    return done;
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
                  .up = difference(up_.conditions(), director_.path().up),
                  .down = difference(down_.conditions(), director_.path().down)},
                 director_.last_reason() == Director::Reason::ramp);
    place_.mark();
    up_.change(director_.path().up, now);
    down_.change(director_.path().down, now);
}

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/control/frames.hpp"

#include "proto/base/fields_json.hpp"
#include "proto/base/figures/counters.hpp"
#include "proto/control/core/reply.hpp"

#include <algorithm>

namespace hapnet::emulator {

namespace {

constexpr std::array directions{Direction::up, Direction::down};

} // namespace

control::FrameSource Frames::watch(AllPaths& paths, const control::DoWork& work)
{
    const Look first = share_out(paths, work); // excludes earlier traffic
    auto watch = std::make_shared<Watch>();
    for (const SeenPath& one : first.paths) {
        Ways& ways = watch->paths[one.name];
        for (std::size_t i = 0; i < ways.size(); ++i) ways[i].counters = one.ways[i].counters;
    }
    watches_.push_back(watch);
    return [self = shared_from_this(), watch, &paths, work](std::string& text,
                                                            std::uint64_t left_out) {
        write(text, *watch, self->share_out(paths, work), left_out);
    };
}

Frames::Look Frames::look(AllPaths& paths)
{
    const auto all = paths.all();
    Look look{paths.latest_now(), paths.elapsed(), paths.generation(), all.size(), {}};
    for (std::size_t i = 0; i < std::min(all.size(), paths_max); ++i) {
        SeenPath& one = look.paths.emplace_back(SeenPath{all[i]->name, {}});
        for (std::size_t way = 0; way < directions.size(); ++way) {
            const Counters& counters = all[i]->path->link(directions[way]).statistics();
            one.ways[way] = {all[i]->path->take_pulse(directions[way]), counters};
        }
    }
    return look;
}

Frames::Look Frames::share_out(AllPaths& paths, const control::DoWork& work)
{
    Look look;
    work([&] {
        look = Frames::look(paths);
        return true;
    });
    std::erase_if(watches_, [](const auto& watch) { return watch.expired(); });
    for (const SeenPath& one : look.paths) {
        for (std::size_t i = 0; i < one.ways.size(); ++i) {
            if (one.ways[i].pulse.count == 0) continue;
            for (const auto& watch : watches_) {
                if (const auto own = watch.lock()) {
                    own->paths[one.name][i].pulse.add(one.ways[i].pulse);
                }
            }
        }
    }
    return look;
}

WayFrame Frames::frame_of(Way& way, const Seen& seen)
{
    // The counters of a path that was removed and added again begin at 0.
    if (seen.counters.received < way.counters.received) way = {};
    const WayFrame frame{base::counted_since(seen.counters, way.counters), way.pulse};
    way = {{}, seen.counters};
    return frame;
}

void Frames::write(std::string& text, Watch& watch, const Look& look, std::uint64_t left_out)
{
    EmulatorFrame frame{.number = watch.frames++,
                        .at = look.at,
                        .elapsed = look.elapsed,
                        .generation = look.generation,
                        .paths = {}};
    for (const SeenPath& one : look.paths) {
        Ways& ways = watch.paths[one.name];
        frame.paths.push_back(
            {one.name, frame_of(ways[0], one.ways[0]), frame_of(ways[1], one.ways[1])});
    }
    if (look.all_paths > look.paths.size()) {
        frame.paths_left_out = look.all_paths - look.paths.size();
    }
    if (left_out > 0) frame.left_out = left_out;
    text += control::line_of(base::json_of(frame));
    if (watch.paths.size() <= 2 * paths_max) return;
    // Clients come and go: remove the entries of those that have gone.
    std::erase_if(watch.paths, [&](const auto& entry) {
        return std::ranges::none_of(look.paths,
                                    [&](const SeenPath& one) { return one.name == entry.first; });
    });
}

} // namespace hapnet::emulator

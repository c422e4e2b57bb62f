// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/control/frames.hpp"

#include <algorithm>
#include <iterator>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

constexpr std::array directions{Direction::up, Direction::down};

template <typename... Values>
void put(std::string& text, fmt::format_string<Values...> form, Values&&... values)
{
    fmt::format_to(std::back_inserter(text), form, std::forward<Values>(values)...);
}

void put_name(std::string& text, std::string_view name)
{
    text += '"';
    for (const char c : name) { // of letters, digits and few signs; see path_name.hpp
        if (c != '"' && c != '\\' && static_cast<unsigned char>(c) >= ' ') text += c;
    }
    text += '"';
}

void put_pulse(std::string& text, const Pulse& pulse)
{
    if (pulse.count == 0) {
        text += ",\"delay_ms\":null,\"late_us\":null}";
        return;
    }
    const auto count = static_cast<double>(pulse.count);
    put(text,
        ",\"delay_ms\":{{\"min\":{:.4f},\"mean\":{:.4f},\"max\":{:.4f}}},"
        "\"late_us\":{{\"mean\":{:.1f},\"max\":{:.1f}}}}}",
        base::to_nanoseconds(pulse.delay_min) / 1e6, pulse.delay_sum_ns / count / 1e6,
        base::to_nanoseconds(pulse.delay_max) / 1e6, pulse.late_sum_ns / count / 1e3,
        base::to_nanoseconds(pulse.late_max) / 1e3);
}

} // namespace

control::FrameSource Frames::watch(AllPaths& paths, const control::DoWork& work)
{
    const Look first = share_out(paths, work); // what left before belongs to the others
    auto watch = std::make_shared<Watch>();
    for (const SeenPath& one : first.paths) {
        Ways& ways = watch->paths[one.name];
        for (std::size_t i = 0; i < ways.size(); ++i) ways[i].counts = one.ways[i].counts;
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
            const Statistics& now = all[i]->path->link(directions[way]).statistics();
            one.ways[way] = {all[i]->path->take_pulse(directions[way]),
                             {now.received, now.delivered, now.duplicated, now.dropped},
                             now.in_flight};
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

void Frames::write(std::string& text, Way& way, const Seen& seen)
{
    const Counts& now = seen.counts;
    // A path that has gone and come again begins at 0.
    if (now.received < way.counts.received) way = {};
    put(text, "{{\"received\":{},\"delivered\":{},\"duplicated\":{},\"dropped\":{{",
        now.received - way.counts.received, now.delivered - way.counts.delivered,
        now.duplicated - way.counts.duplicated);
    bool is_first = true;
    for (std::size_t i = 0; i < drop_causes.size(); ++i) {
        const auto count = now.dropped[i] - way.counts.dropped[i];
        if (count == 0) continue;
        put(text, "{}\"{}\":{}", is_first ? "" : ",", to_text(drop_causes[i]), count);
        is_first = false;
    }
    put(text, "}},\"in_flight\":{}", seen.in_flight);
    put_pulse(text, way.pulse);
    way = {{}, now};
}

void Frames::write(std::string& text, Watch& watch, const Look& look, std::uint64_t left_out)
{
    put(text,
        "{{\"ok\":true,\"frame\":{},\"at_ns\":{},\"elapsed_s\":{:.4f},\"generation\":{},\"paths\":"
        "[",
        watch.frames++, look.at.time_since_epoch().count(), base::to_seconds(look.elapsed),
        look.generation);
    for (const SeenPath& one : look.paths) {
        Ways& ways = watch.paths[one.name];
        text += &one == look.paths.data() ? "{\"name\":" : ",{\"name\":";
        put_name(text, one.name);
        text += ",\"up\":";
        write(text, ways[0], one.ways[0]);
        text += ",\"down\":";
        write(text, ways[1], one.ways[1]);
        text += '}';
    }
    text += ']';
    if (look.all_paths > look.paths.size()) {
        put(text, ",\"paths_left_out\":{}", look.all_paths - look.paths.size());
    }
    if (left_out > 0) put(text, ",\"left_out\":{}", left_out);
    text += '}';
    if (watch.paths.size() <= 2 * paths_max) return;
    // Clients come and go: forget those that have gone.
    std::erase_if(watch.paths, [&](const auto& entry) {
        return std::ranges::none_of(look.paths,
                                    [&](const SeenPath& one) { return one.name == entry.first; });
    });
}

} // namespace hapnet::emulator

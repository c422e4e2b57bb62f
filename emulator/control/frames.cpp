// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/control/frames.hpp"

#include <algorithm>
#include <iterator>
#include <span>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

constexpr std::array directions{Direction::up, Direction::down};

/// The paths that a frame has room for.
std::span<const Paths::Named* const> shown(const std::vector<const Paths::Named*>& all)
{
    return std::span{all}.first(std::min(all.size(), Frames::paths_max));
}

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

control::FrameSource Frames::watch(AllPaths& paths)
{
    share_out(paths); // what left before belongs to the others
    auto watch = std::make_shared<Watch>();
    const auto all = paths.all();
    for (const Paths::Named* one : shown(all)) {
        Ways& ways = watch->paths[one->name];
        for (std::size_t i = 0; i < directions.size(); ++i) {
            begin(ways[i], one->path->link(directions[i]).statistics());
        }
    }
    watches_.push_back(watch);
    return [self = shared_from_this(), watch, &paths](std::string& text, std::uint64_t left_out) {
        self->share_out(paths);
        write(text, *watch, paths, left_out);
    };
}

/// Gives what has left the links to every watch.
void Frames::share_out(AllPaths& paths)
{
    std::erase_if(watches_, [](const auto& watch) { return watch.expired(); });
    const auto all = paths.all();
    for (const Paths::Named* one : shown(all)) {
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const Pulse pulse = one->path->take_pulse(directions[i]);
            if (pulse.count == 0) continue;
            for (const auto& watch : watches_) {
                if (const auto own = watch.lock()) own->paths[one->name][i].pulse.add(pulse);
            }
        }
    }
}

void Frames::begin(Way& way, const Statistics& statistics)
{
    way.pulse = {};
    way.received = statistics.received;
    way.delivered = statistics.delivered;
    way.duplicated = statistics.duplicated;
    way.dropped = statistics.dropped;
}

void Frames::write(std::string& text, Way& way, const Statistics& statistics)
{
    // A path that has gone and come again begins at 0.
    if (statistics.received < way.received) way = {};
    put(text, "{{\"received\":{},\"delivered\":{},\"duplicated\":{},\"dropped\":{{",
        statistics.received - way.received, statistics.delivered - way.delivered,
        statistics.duplicated - way.duplicated);
    bool is_first = true;
    for (std::size_t i = 0; i < drop_causes.size(); ++i) {
        const auto count = statistics.dropped[i] - way.dropped[i];
        if (count == 0) continue;
        put(text, "{}\"{}\":{}", is_first ? "" : ",", to_text(drop_causes[i]), count);
        is_first = false;
    }
    put(text, "}},\"in_flight\":{}", statistics.in_flight);
    put_pulse(text, way.pulse);
    begin(way, statistics);
}

void Frames::write(std::string& text, Watch& watch, AllPaths& paths, std::uint64_t left_out)
{
    const auto all = paths.all();
    const auto seen = shown(all);
    const auto at = paths.latest_now();
    put(text,
        "{{\"ok\":true,\"frame\":{},\"at_ns\":{},\"elapsed_s\":{:.4f},\"generation\":{},\"paths\":"
        "[",
        watch.frames++, at.time_since_epoch().count(), base::to_seconds(paths.elapsed()),
        paths.generation());
    for (const Paths::Named* one : seen) {
        Ways& ways = watch.paths[one->name];
        text += one == seen.front() ? "{\"name\":" : ",{\"name\":";
        put_name(text, one->name);
        text += ",\"up\":";
        write(text, ways[0], one->path->link(Direction::up).statistics());
        text += ",\"down\":";
        write(text, ways[1], one->path->link(Direction::down).statistics());
        text += '}';
    }
    text += ']';
    if (all.size() > seen.size()) put(text, ",\"paths_left_out\":{}", all.size() - seen.size());
    if (left_out > 0) put(text, ",\"left_out\":{}", left_out);
    text += '}';
    if (watch.paths.size() <= 2 * paths_max) return;
    // Clients come and go: forget those that have gone.
    std::erase_if(watch.paths, [&](const auto& entry) {
        return std::ranges::none_of(
            seen, [&](const Paths::Named* one) { return one->name == entry.first; });
    });
}

} // namespace hapnet::emulator

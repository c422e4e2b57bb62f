// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/event_log.hpp"

#include "proto/disk/create.hpp"

#include <cerrno>
#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <unistd.h>

namespace hapnet::peer::monitor {

namespace {

disk::Outcome<disk::Descriptor> opened(const std::string& path)
{
    const auto place = disk::Place::find(path);
    if (!place) return tl::unexpected{place.error()};
    // A FIFO is also opened for reading, because opening only the writing end would wait for a
    // reader.
    auto file = disk::open_to_write(*place, place->is_pipe() ? O_RDWR : O_WRONLY, 0644);
    if (file && place->is_regular() && ftruncate(file->number(), 0) != 0)
        return tl::unexpected{std::error_code{errno, std::generic_category()}};
    return file;
}

/// Returns `own` with a new queue that writes to this place; it stays empty for stdout.
std::optional<net::TextQueue>& queue_to(const std::string& place,
                                        std::optional<net::TextQueue>& own)
{
    if (place == "-") return own;
    auto file = opened(place);
    if (!file) {
        throw std::system_error{file.error(), fmt::format("--events: cannot write {}", place)};
    }
    own.emplace(file->release()); // never closed: the thread that writes may outlive the queue
    return own;
}

} // namespace

std::string_view name_of(Event event)
{
    switch (event) {
    case Event::met: return "met";
    case Event::agreed: return "agreed";
    case Event::started: return "started";
    case Event::joined: return "joined";
    case Event::lost: return "lost";
    case Event::back: return "back";
    case Event::restarted: return "restarted";
    case Event::left: return "left";
    case Event::refused: return "refused";
    case Event::hands_off: return "hands_off";
    case Event::ended: return "ended";
    case Event::stopped: return "stopped_early";
    case Event::no_body: return "no_body";
    case Event::clock_jumped: return "clock_jumped";
    }
    return "";
}

LoggedEvent event_of(const loop::TimedDeviceNews& timed)
{
    const DeviceNews& news = timed.news;
    LoggedEvent event{.at = timed.at, .name = ""};
    switch (news.change) {
    case DeviceChange::fault:
        if (news.fault.fault == device::Fault::none) {
            event.name = "fault_cleared";
            return event;
        }
        event.name = "fault";
        event.details = {{"fault", device::name_of(news.fault.fault)},
                         {"tripped_by", device::name_of(news.fault.trip)}};
        return event;
    case DeviceChange::calibration:
        event.name =
            news.calibration == device::CalibrationStep::done ? "calibrated" : "calibrating";
        return event;
    case DeviceChange::energy:
        event.name = "energy_limited";
        event.details = {{"ticks", news.energy_limited_ticks}};
        return event;
    }
    return event;
}

std::string line_of(const LoggedEvent& event, std::optional<base::TimePoint> start)
{
    nlohmann::ordered_json line{{"at_ns", event.at.time_since_epoch().count()},
                                {"event", event.name},
                                {"peer", nullptr},
                                {"session_s", nullptr},
                                {"text", nullptr}};
    if (event.about != 0) line["peer"] = event.about;
    if (start && event.at >= *start) line["session_s"] = base::to_seconds(event.at - *start);
    if (!event.words.empty()) line["text"] = event.words;
    if (event.details.is_object()) line.update(event.details);
    return line.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

EventLog::EventLog(const std::string& place, net::TextQueue& out)
    : queue_{queue_to(place, own_) ? *own_ : out}
{}

} // namespace hapnet::peer::monitor

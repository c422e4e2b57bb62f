// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/event_log.hpp"

#include <cerrno>
#include <fcntl.h>
#include <spdlog/fmt/fmt.h>
#include <sys/stat.h>
#include <system_error>

namespace hapnet::peer::monitor {

namespace {

/// To write there; nullopt for stdout. Of a FIFO also the end that is read: opening the other alone
/// would wait for a reader.
std::optional<net::TextQueue>& opened(const std::string& place, std::optional<net::TextQueue>& own)
{
    if (place == "-") return own;
    struct stat found {};
    const bool is_fifo = stat(place.c_str(), &found) == 0 && S_ISFIFO(found.st_mode);
    const int descriptor =
        open(place.c_str(), (is_fifo ? O_RDWR : O_WRONLY | O_CREAT | O_TRUNC) | O_CLOEXEC, 0644);
    if (descriptor < 0) {
        throw std::system_error{errno, std::generic_category(),
                                fmt::format("--events: cannot write {}", place)};
    }
    own.emplace(descriptor); // never closed: the thread that writes may outlive the queue
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
    : queue_{opened(place, own_) ? *own_ : out}
{}

} // namespace hapnet::peer::monitor

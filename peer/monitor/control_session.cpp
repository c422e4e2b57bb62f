// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/control_session.hpp"

#include "peer/control/answer.hpp"
#include "peer/control/scene_report.hpp"
#include "peer/monitor/report.hpp"
#include "proto/base/fields.hpp"

#include <utility>

namespace hapnet::peer::monitor {

namespace {

constexpr base::Duration request_every{std::chrono::milliseconds{50}};

} // namespace

ControlSession::ControlSession(Parts parts) : parts_{std::move(parts)}, subject_{subject()} {}

control::Subject ControlSession::subject()
{
    const auto run = [this] {
        return Run{parts_.options,
                   *status_,
                   parts_.device,
                   parts_.monitor.is_record_whole(),
                   parts_.monitor.rows_lost(),
                   0,
                   parts_.monitor.are_events_whole()};
    };
    decltype(PeerControl::hand) hand;
    if (const auto& page = parts_.options.device.page) {
        hand = [page](const auto& wish) { page->put(wish); };
    }
    return subject_of(
        {.show = [this, run] { return show_json(run(), parts_.recovery); },
         .statistics = [this, run] { return statistics_json(run(), status_->elapsed); },
         .statistics_fields = base::field_table<PeerStatistics>(),
         .stop = [this] { parts_.stop.request(); },
         .stop_in_emergency = [this] { parts_.gate.stop_in_emergency(); },
         .scene = [this] { return scene_json(parts_.options.scene); },
         .frames = [this] { return parts_.monitor.watch_frames(); },
         .held = parts_.monitor.held(),
         .keep = [this](const std::string& name,
                        base::TimePoint from) { return parts_.monitor.keep(name, from); },
         .hand = std::move(hand)});
}

void ControlSession::serve(base::TimePoint now)
{
    if (loop::ServoStatus newer; parts_.servo.take_status(newer)) status_ = newer;
    if (!next_request_ || base::is_due(next_request_, now)) {
        parts_.servo.request_status();
        next_request_ = now + request_every;
    }
    if (status_) parts_.server.serve(subject_, now);
}

} // namespace hapnet::peer::monitor

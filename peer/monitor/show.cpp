// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/text.hpp"
#include "peer/monitor/report.hpp"
#include "proto/base/version.hpp"

#include <string>
#include <string_view>

namespace hapnet::peer {

namespace {

using Ordered = nlohmann::ordered_json;

bool is_at_fault(const Standing& standing) { return standing.fault.fault != device::Fault::none; }

bool is_calibrating(const Standing& standing)
{
    return standing.calibration != device::CalibrationStep::done;
}

std::string_view words_on_phase(const Standing& standing)
{
    switch (standing.phase) {
    case record::Phase::waiting:
        return "waiting for the other peer; is it running, and is the emulator between the two?";
    case record::Phase::countdown: return "the session starts within a second";
    case record::Phase::running:
        return standing.is_remote_heard ? "in session"
                                        : "in session, but the other peer is silent: zero force";
    case record::Phase::hands_off: return "in session, hands off";
    case record::Phase::alone: return "the other peer has said goodbye: alone, with zero force";
    case record::Phase::ended: return "the session has ended";
    }
    return "";
}

/// What most concerns whoever asks: a fault, the calibration, the session, in this order.
std::string_view state_of(const Standing& standing)
{
    if (is_at_fault(standing)) return "fault";
    return is_calibrating(standing) ? "calibrating" : record::name_of(standing.phase);
}

std::string says(const Standing& standing, const WaysBack& ways_back)
{
    DeviceNews news{standing.calibration, standing.fault, false, ways_back};
    if (is_at_fault(standing)) return words_for(news);
    news.is_of_calibration = true;
    if (is_calibrating(standing)) return words_for(news);
    return std::string{words_on_phase(standing)};
}

Ordered shown_session(const Run& run)
{
    const auto& session = run.standing.session;
    if (!session) return nullptr;
    return {{"number", session->number},
            {"role", session->is_left ? "L" : "R"},
            {"at_s", base::to_seconds(run.standing.at - session->start)}};
}

Ordered shown_fault(const Standing& standing)
{
    if (!is_at_fault(standing)) return nullptr;
    return {{"fault", device::name_of(standing.fault.fault)},
            {"tripped_by", device::name_of(standing.fault.trip)}};
}

} // namespace

Ordered show_json(const Run& run, const WaysBack& ways_back)
{
    const Options& options = run.options;
    const Standing& standing = run.standing;
    return {{"program", "hapnet-peer"},
            {"version", base::version()},
            {"peer_id", options.id},
            {"task", device::name_of(options.task)},
            {"scene", options.scene_name},
            {"algorithm", name_of(options.algorithm)},
            {"seed", options.seed.value()},
            {"duration_s", base::to_seconds(options.duration)},
            {"device", run.device},
            {"force_limit_n", standing.force_limit_n},
            {"elapsed_s", base::to_seconds(standing.elapsed)},
            {"state", state_of(standing)},
            {"says", says(standing, ways_back)},
            {"phase", record::name_of(standing.phase)},
            {"remote_heard", standing.is_remote_heard},
            {"session", shown_session(run)},
            {"force_n", base::norm(standing.force)},
            {"governor", device::name_of(standing.governor_state)},
            {"fault", shown_fault(standing)}};
}

} // namespace hapnet::peer

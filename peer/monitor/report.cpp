// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/report.hpp"

#include "peer/monitor/monitor.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/base/text.hpp"
#include "proto/net/clock.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer::monitor {

namespace {

using Ordered = nlohmann::ordered_json;

bool is_at_fault(const loop::ServoStatus& status)
{
    return status.fault.fault != device::Fault::none;
}

bool is_calibrating(const loop::ServoStatus& status)
{
    return status.calibration != device::CalibrationStep::done;
}

std::string_view words_on_phase(const loop::ServoStatus& status)
{
    switch (status.phase) {
    case record::Phase::waiting:
        return status.is_pair() ? "waiting for the other peer; is it running, and is the emulator "
                                  "between the two?"
                                : "waiting for the other peers; are they running, and is the "
                                  "emulator between all?";
    case record::Phase::countdown: return "the session starts within a second";
    case record::Phase::running:
        if (status.is_remote_heard) return "in session";
        return status.is_pair() ? "in session, but the other peer is silent: zero force"
                                : "in session, but all other peers are silent: zero force";
    case record::Phase::hands_off: return "in session, hands off";
    case record::Phase::alone:
        return status.is_pair() ? "the other peer has said goodbye: alone, with zero force"
                                : "all others have said goodbye: alone, with zero force";
    case record::Phase::ended: return "the session has ended";
    }
    return "";
}

/// Returns why the hand gets no force, and what to do; "" if force is not withheld.
std::string_view words_on(loop::Withheld withheld)
{
    switch (withheld) {
    case loop::Withheld::no: return "";
    case loop::Withheld::by_stop: return "stopping: zero force";
    case loop::Withheld::by_emergency_stop:
        return "emergency stop: zero force; only a new start of the program gives force again";
    case loop::Withheld::by_dead_man:
        return "the dead man's switch is not held: zero force; hold it, and the force ramps in";
    }
    return "";
}

/// Returns the most important state: a stop, a fault, the calibration or the session, in this
/// order.
std::string_view state_of(const loop::ServoStatus& status)
{
    if (status.withheld == loop::Withheld::by_emergency_stop) return "emergency_stop";
    if (is_at_fault(status)) return "fault";
    return is_calibrating(status) ? "calibrating" : record::name_of(status.phase);
}

std::string says(const loop::ServoStatus& status, const Recovery& recovery)
{
    DeviceNews news{.calibration = status.calibration, .fault = status.fault, .recovery = recovery};
    std::string withheld{words_on(status.withheld)};
    if (status.withheld == loop::Withheld::by_emergency_stop) return withheld;
    if (is_at_fault(status)) return describe(news);
    news.change = DeviceChange::calibration;
    if (is_calibrating(status)) return describe(news);
    if (!withheld.empty()) return withheld;
    if (const auto trouble = describe(status.loop.last_send); !trouble.empty()) {
        return fmt::format("nothing can be sent to the other peer: {}", trouble);
    }
    return std::string{words_on_phase(status)};
}

Ordered shown_session(const Run& run)
{
    const auto& session = run.status.session;
    if (!session) return nullptr;
    return {{"number", run.status.is_pair() ? Ordered(session->number) : Ordered{}},
            {"role", run.status.is_left ? "L" : "R"},
            {"at_s", base::to_seconds(run.status.at - session->start)}};
}

Ordered shown_others(const loop::ServoStatus& status)
{
    auto out = Ordered::array();
    for (const loop::OtherStatus& other : others_of(status)) {
        out.push_back({{"id", other.id != 0 ? Ordered(other.id) : Ordered{}},
                       {"heard", other.is_heard},
                       {"gone", other.is_gone}});
    }
    return out;
}

Ordered shown_fault(const loop::ServoStatus& status)
{
    if (!is_at_fault(status)) return nullptr;
    return {{"fault", device::name_of(status.fault.fault)},
            {"tripped_by", device::name_of(status.fault.trip)}};
}

} // namespace

nlohmann::ordered_json configuration_json(const Options& options, std::string_view device)
{
    return base::json_of(PeerConfiguration{&options, device});
}

nlohmann::ordered_json statistics_json(const Run& run, std::optional<base::Duration> elapsed)
{
    PeerStatistics statistics = statistics_of(run);
    statistics.elapsed = elapsed;
    return base::json_of(statistics);
}

Ordered show_json(const Run& run, const Recovery& recovery)
{
    const Options& options = run.options;
    const loop::ServoStatus& status = run.status;
    return {{"program", "hapnet-peer"},
            {"version", base::version()},
            {"peer_id", options.id},
            {"task", device::name_of(options.task)},
            {"scene", options.scene_name},
            {"algorithm", name_of(options.algorithm)},
            {"seed", options.seed.value()},
            {"duration_s", base::to_seconds(options.duration)},
            {"device", run.device},
            {"takes_hand", options.device.page != nullptr},
            {"force_limit_n", status.force_limit_n},
            {"tick_rate_hz", 1000},
            {"boot_id", net::boot_id()},
            {"held_s",
             options.keep.span ? Ordered(base::to_seconds(*options.keep.span)) : Ordered(nullptr)},
            {"elapsed_s", base::to_seconds(status.elapsed)},
            {"state", state_of(status)},
            {"says", says(status, recovery)},
            {"phase", record::name_of(status.phase)},
            {"remote_heard", status.is_remote_heard},
            {"session", shown_session(run)},
            {"others", shown_others(status)},
            {"force_n", base::norm(status.force)},
            {"governor", device::name_of(status.governor_state)},
            {"force_withheld", status.withheld != loop::Withheld::no},
            {"fault", shown_fault(status)}};
}

std::string summary(const Run& run)
{
    const loop::LoopCounters& loop = run.status.loop;
    const Counters& c = run.status.messages;
    const auto p99 = loop.late.quantile(0.99);
    std::string text =
        fmt::format("hapnet-peer {}: {} ticks, {} missed", run.options.id, loop.ticks, loop.missed);
    if (p99) text += fmt::format(", p99 lateness {:.0f} us", base::to_seconds(*p99) * 1e6);
    text += fmt::format("; {} states sent, {} received", c.sent, c.states);
    if (const auto why = why_not_valid(run); !why.empty()) {
        text += fmt::format("; NOT VALID as a measurement: {}", why);
    }
    text += '\n';
    if (const auto ticks = run.status.governor.energy_limited; ticks > 0) {
        text += fmt::format("hapnet-peer {}: the energy into the hand was limited in {} ticks: the "
                            "other side pushed harder than any task needs\n",
                            run.options.id, ticks);
    }
    if (!run.is_record_whole) {
        text += fmt::format("hapnet-peer {}: NOT COMPLETE: the record could not be written to its "
                            "end\n",
                            run.options.id);
    }
    if (run.rows_lost > 0) {
        text += fmt::format("hapnet-peer {}: {} rows of the record were lost\n", run.options.id,
                            run.rows_lost);
    }
    if (const auto left_out = loop.unrecorded; left_out > 0 && run.options.record) {
        text += fmt::format("hapnet-peer {}: a flood of {} datagrams that had no effect was left "
                            "out of the record\n",
                            run.options.id, left_out);
    }
    if (loop.too_long > 0 && run.options.record) {
        text += fmt::format("hapnet-peer {}: {} messages were longer than any of this scene, and "
                            "were left out of the record\n",
                            run.options.id, loop.too_long);
    }
    if (run.texts_lost > 0) {
        text += fmt::format("hapnet-peer {}: {} messages were lost, as they were not read\n",
                            run.options.id, run.texts_lost);
    }
    return text;
}

} // namespace hapnet::peer::monitor

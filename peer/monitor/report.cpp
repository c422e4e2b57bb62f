// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/report.hpp"

#include "peer/control/statistics.hpp"
#include "peer/core/sync/text.hpp"
#include "peer/monitor/monitor.hpp"
#include "proto/base/text.hpp"
#include "proto/base/version.hpp"
#include "proto/net/clock.hpp"
#include "scene/text/text.hpp"

#include <algorithm>
#include <span>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer::monitor {

namespace {

using nlohmann::json;

// A run is valid when 99 % of its ticks are at most this late and at most this share is missed.
constexpr base::Duration late_budget{std::chrono::milliseconds{1}};
constexpr double missed_share_budget = 0.005;

json microseconds(std::optional<base::Duration> duration)
{
    if (!duration) return nullptr;
    return base::to_seconds(*duration) * 1e6;
}

double missed_share(const loop::LoopCounters& loop)
{
    const auto all = static_cast<double>(loop.ticks + loop.missed);
    return all > 0.0 ? static_cast<double>(loop.missed) / all : 0.0;
}

json tick_json(const loop::LoopCounters& loop)
{
    return {{"count", loop.ticks},
            {"missed", loop.missed},
            {"missed_share", missed_share(loop)},
            {"late_us",
             {{"p50", microseconds(loop.late.quantile(0.5))},
              {"p90", microseconds(loop.late.quantile(0.9))},
              {"p99", microseconds(loop.late.quantile(0.99))},
              {"p999", microseconds(loop.late.quantile(0.999))},
              {"max", microseconds(loop.late.max())}}}};
}

std::span<const loop::OtherStatus> others_of(const loop::ServoStatus& status)
{
    return std::span{status.others}.first(status.others_count);
}

std::uint64_t strangers_of(const loop::ServoStatus& status)
{
    std::uint64_t strangers = 0;
    for (const loop::OtherStatus& other : others_of(status)) strangers += other.line.strangers;
    return strangers;
}

json messages_json(const Run& run)
{
    json out = peer::messages_json(run.status.messages);
    out["strangers"] = strangers_of(run.status);
    out["overflowed"] = run.status.overflowed;
    out["send_failed"] = run.status.loop.send_failures;
    return out;
}

/// null without a key.
json secure_json(const std::optional<line::Status::Key>& key)
{
    if (!key) return nullptr;
    const secure::Association::Counts& c = key->counts;
    json out{{"agreed", key->is_agreed},
             {"handshakes", c.handshakes},
             {"rekeys", c.rekeys},
             {"key_age_s", nullptr},
             {"forged", c.forged},
             {"replayed", c.replayed},
             {"unsealed", c.unsealed},
             {"unknown_key", c.unknown_key},
             {"other_circle", c.other_circle},
             {"refused", c.refused},
             {"unread", c.unread},
             {"misnamed", key->misnamed},
             {"cookies", c.cookies},
             {"roamed", c.roamed},
             {"not_sent", c.not_sealed},
             {"handshake_ms", nullptr}};
    if (key->age) out["key_age_s"] = base::to_seconds(*key->age);
    if (c.last_handshake > base::Duration{0})
        out["handshake_ms"] = base::to_seconds(c.last_handshake) * 1e3;
    return out;
}

/// All keys together: counts are sums, and there is an agreement when there is one with each.
std::optional<line::Status::Key> all_keys(const loop::ServoStatus& status)
{
    std::optional<line::Status::Key> all;
    for (const loop::OtherStatus& other : others_of(status)) {
        const auto& key = other.line.key;
        if (!key) continue;
        if (!all) {
            all = key;
            continue;
        }
        all->is_agreed = all->is_agreed && key->is_agreed;
        if (key->age) all->age = std::max(all->age.value_or(*key->age), *key->age);
        all->counts += key->counts;
        all->misnamed += key->misnamed;
    }
    return all;
}

json session_json(const Run& run)
{
    const auto& session = run.status.session;
    if (!session) return nullptr;
    // Among more than two, number and clock are of each other: see others[].
    const bool is_pair = run.status.is_pair();
    const auto& clock = run.status.others.front().clock;
    json out{{"number", is_pair ? json(session->number) : json{}},
             {"seed", session->seed},
             {"role", run.status.is_left ? "L" : "R"},
             {"joined_late", session->joined_late},
             {"clock_offset_ms", nullptr},
             {"clock_uncertainty_ms", nullptr}};
    if (is_pair && clock) {
        out["clock_offset_ms"] = base::to_seconds(clock->offset) * 1e3;
        out["clock_uncertainty_ms"] = base::to_seconds(clock->uncertainty) * 1e3;
    }
    return out;
}

json milliseconds(base::Duration duration) { return base::to_seconds(duration) * 1e3; }

json path_json(const PathReport& path)
{
    json out{{"delay_ms", nullptr}, {"jitter_ms", nullptr}, {"age_ms", nullptr}};
    const auto put = [&out](const char* key, const std::optional<base::Quantiles>& times) {
        if (!times) return;
        out[key] = {{"p50", milliseconds(times->p50)},
                    {"p99", milliseconds(times->p99)},
                    {"max", milliseconds(times->max)}};
    };
    put("delay_ms", path.delay);
    put("jitter_ms", path.jitter);
    if (const auto& age = path.age; age.mean) {
        out["age_ms"] = {{"mean", milliseconds(*age.mean)},
                         {"peak_max", milliseconds(*age.peak_max)}};
    }
    return out;
}

json clock_json(const loop::OtherStatus& other)
{
    if (!other.clock) return nullptr;
    return {{"offset_ms", milliseconds(other.clock->offset)},
            {"uncertainty_ms", milliseconds(other.clock->uncertainty)},
            {"skew_ppm", other.clock->skew_ppm},
            {"in_doubt", other.is_clock_in_doubt},
            {"jumps", other.clock_jumps}};
}

json others_json(const loop::ServoStatus& status)
{
    json out = json::array();
    for (const loop::OtherStatus& other : others_of(status)) {
        const base::ArrivalCounts& arrived = other.paths.arrived;
        json in = path_json(other.paths.in);
        in["sent"] = arrived.sent;
        in["received"] = arrived.received;
        in["duplicates"] = arrived.duplicates;
        in["reordered"] = arrived.reordered;
        in["loss"] = other.paths.loss ? json(*other.paths.loss) : json{};
        out.push_back({{"id", other.id != 0 ? json(other.id) : json{}},
                       {"session", other.session != 0 ? json(other.session) : json{}},
                       {"heard", other.is_heard},
                       {"clock", clock_json(other)},
                       {"in", std::move(in)},
                       {"out", path_json(other.paths.out)},
                       {"secure", secure_json(other.line.key)}});
    }
    return out;
}

json governor_json(const Run& run)
{
    const loop::ServoStatus& status = run.status;
    json out = peer::governor_json({.state = status.governor_state,
                                    .fault = status.fault,
                                    .force_limit_n = status.force_limit_n,
                                    .motor_heat = status.motor_heat,
                                    .counters = status.governor,
                                    .device = status.device});
    out["watchdog_halts"] = status.watchdog_halts;
    out["withheld"] = status.loop.withheld;
    out["unusable_samples"] = status.messages.unusable_hand;
    return out;
}

json energy_json(const loop::ServoStatus& status)
{
    const auto& limits = status.energy_limits;
    if (!limits) return nullptr;
    const device::EnergyFigures& energy = status.energy;
    return {{"limited_ticks", status.governor.energy_limited},
            {"power_limit_w", limits->power_max_w},
            {"work_5s_limit_j", limits->work_max_j},
            {"net_j", energy.net_j},
            {"net_max_j", energy.net_max_j},
            {"work_5s_max_j", energy.work_5s_max_j},
            {"power_max_w", energy.power_max_w}};
}

/// The reason why the run is not valid as a measurement; "" when it is.
std::string why_not_valid(const Run& run)
{
    const loop::LoopCounters& loop = run.status.loop;
    const auto p99 = loop.late.quantile(0.99);
    if (!p99) return "no tick began";
    if (missed_share(loop) > missed_share_budget) {
        return fmt::format("{:.2g} % of the ticks were missed, more than {} %",
                           1e2 * missed_share(loop), 1e2 * missed_share_budget);
    }
    if (*p99 > late_budget) {
        return fmt::format("p99 lateness {:.0f} us, more than {:.0f} us",
                           base::to_seconds(*p99) * 1e6, base::to_seconds(late_budget) * 1e6);
    }
    // A fault that an operator has ended counts, too: the hand did not play meanwhile.
    const device::GovernorCounters& c = run.status.governor;
    const std::uint64_t faults = c.device_faults + c.silence_faults + c.loop_faults +
                                 c.speed_trips + c.jump_trips + c.nonsense_trips + c.frozen_trips +
                                 c.runaway_trips;
    if (faults > 0) {
        return fmt::format("the device was at fault {}",
                           faults == 1 ? "once" : fmt::format("{} times", faults));
    }
    return run.options.record && !run.is_record_whole ? "the record is not complete" : "";
}

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

/// Who keeps the force from the hand, and what to do; "" when nobody does.
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

/// The most important state: a stop, a fault, the calibration or the session, in this order.
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

/// Of the roster: 0 is whoever answers.
json ids_of(const Options& options)
{
    return options.others.empty() ? json::array() : json(options.roster().others);
}

} // namespace

json configuration_json(const Options& options, std::string_view device)
{
    const bool simulated = options.device.is_simulated();
    return {{"program", "hapnet-peer"},
            {"version", base::version()},
            {"commit", base::commit()},
            {"compiler", base::compiler()},
            {"peer_id", options.id},
            {"task", device::name_of(options.task)},
            {"scene", options.scene_name},
            {"scene_toml", scene::to_text(options.scene)},
            {"scene_hash", fmt::format("{:016x}", scene::hash(options.scene))},
            {"grip_damping_ns_per_m", options.grip_damping_ns_per_m},
            {"force_limit_n", options.force_max_n},
            {"algorithm", name_of(options.algorithm)},
            {"algorithm_toml", print_algorithm(options.algorithm)},
            {"seed", options.seed.value()},
            {"device", device},
            {"operator", simulated ? json(options.device.person.name) : json{}},
            {"operator_toml", simulated ? json(print_operator(options.device.person)) : json{}},
            {"duration_s", base::to_seconds(options.duration)},
            {"peers", ids_of(options)},
            {"wait_for", options.wait_for},
            {"tick_ns", 1'000'000},
            {"wire", wire::protocol_version},
            {"boot_id", net::boot_id()},
            {"started_unix_s", net::wall_clock_seconds()}};
}

json statistics_json(const Run& run)
{
    json out = configuration_json(run.options, run.device);
    out.erase("started_unix_s");
    out["session"] = session_json(run);
    out["others"] = others_json(run.status);
    out["secure"] = secure_json(all_keys(run.status));
    out["tick"] = tick_json(run.status.loop);
    out["messages"] = messages_json(run);
    out["governor"] = governor_json(run);
    out["energy"] = energy_json(run.status);
    out["record_rows_lost"] = run.rows_lost + run.status.loop.unrecorded + run.status.loop.too_long;
    out["texts_lost"] = run.texts_lost;
    out["record_whole"] = run.options.record ? json(run.is_record_whole) : json{};
    out["real_time"] = {{"fifo", run.status.real_time.fifo},
                        {"locked_memory", run.status.real_time.locked_memory}};
    out["refusal"] = nullptr;
    if (const auto reason = run.status.refusal) out["refusal"] = describe(*reason);
    out["valid"] = why_not_valid(run).empty();
    return out;
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

std::string_view describe(wire::ByeReason reason)
{
    switch (reason) {
    case wire::ByeReason::finished: return "finished";
    case wire::ByeReason::interrupted: return "interrupted";
    case wire::ByeReason::other_version:
        return "the other speaks another version of the protocol: use the same version of hapnet "
               "on both sides";
    case wire::ByeReason::other_scene:
        return "the other has another scene: give both the same --scene";
    case wire::ByeReason::other_task:
        return "the other has another task: give both the same --task";
    case wire::ByeReason::other_tick_rate:
        return "the other has another tick rate: use the same version of hapnet on both sides";
    case wire::ByeReason::same_id: return "the other has the same id: give the two different --id";
    }
    return "";
}

} // namespace hapnet::peer::monitor

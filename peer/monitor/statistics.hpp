// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/cli/options.hpp"
#include "peer/control/statistics.hpp"
#include "peer/core/sync/text.hpp"
#include "peer/loop/servo_status.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/version.hpp"
#include "proto/net/clock.hpp"
#include "scene/text/text.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::peer::monitor {

// The statistics that --stats writes and that `stats` returns, see docs/formats/statistics.md. Most
// of them are copied from the status of the loop.

/// The input of all reports.
struct Run {
    const Options& options;
    const loop::ServoStatus& status;
    std::string device;
    bool is_record_whole = true;
    std::uint64_t rows_lost = 0;  // rows lost on their way to the record
    std::uint64_t texts_lost = 0; // messages for a person that were not read in time
    bool are_events_whole = true;
};

/// The program and its build.
struct BuildReport {
    std::string_view program = "hapnet-peer";
    std::string_view version = base::version();
    std::string_view commit = base::commit();
    std::string_view compiler = base::compiler();
};
constexpr auto fields_of(base::Tag<BuildReport>)
{
    using B = BuildReport;
    return base::fields("build", base::member("program", &B::program, "The program that ran."),
                        base::member("version", &B::version, "Its version."),
                        base::member("commit", &B::commit, "The commit that it was built from."),
                        base::member("compiler", &B::compiler, "What it was built with."));
}

/// The configuration of a peer in the form that records and statistics contain.
struct PeerConfiguration {
    const Options* options = nullptr;
    std::string_view device;
    BuildReport build{};

    /// Returns nullopt if the device is not simulated.
    template <typename Tell>
    [[nodiscard]] std::optional<std::string> of_hand(const Tell& tell) const
    {
        if (!options->device.is_simulated()) return std::nullopt;
        return tell(options->device.person);
    }
};
/// Returns the value of an option.
template <auto Option>
inline constexpr auto option = [](const PeerConfiguration& one) -> const auto&
{
    return one.options->*Option;
};
constexpr auto fields_of(base::Tag<PeerConfiguration>)
{
    using C = PeerConfiguration;
    return base::fields(
        "configuration", base::part(&C::build),
        base::computed<C>("peer_id", option<&Options::id>, "The `--id`."),
        base::computed<C>("task", option<&Options::task>, "The `--task`."),
        base::computed<C>("scene", option<&Options::scene_name>, "The name of the scene."),
        base::computed<C>(
            "scene_toml", [](const C& one) { return scene::to_text(one.options->scene); },
            "Its full text."),
        base::computed<C>(
            "scene_hash",
            [](const C& one) { return fmt::format("{:016x}", scene::hash(one.options->scene)); },
            "Its hash as both peers compare it."),
        base::computed<C>("grip_damping_ns_per_m", option<&Options::grip_damping_ns_per_m>,
                          "As given by the option."),
        base::computed<C>("force_limit_n", option<&Options::force_max_n>,
                          "As given by the option."),
        base::computed<C>(
            "algorithm", [](const C& one) { return name_of(one.options->algorithm); },
            "The name of the algorithm."),
        base::computed<C>(
            "algorithm_toml", [](const C& one) { return print_algorithm(one.options->algorithm); },
            "All its parameters."),
        base::computed<C>(
            "send", [](const C& one) { return text_of(one.options->send); }, "The `--send`."),
        base::computed<C>("playout", option<&Options::playout>, "The `--playout`."),
        base::computed<C>(
            "clock", [](const C& one) { return text_of(one.options->clock); },
            "The `--clock`, with its error."),
        base::computed<C>(
            "seed", [](const C& one) { return one.options->seed.value(); }, "The `--seed`."),
        base::member("device", &C::device, "The device in words."),
        base::computed<C>(
            "operator",
            [](const C& one) { return one.of_hand([](const auto& hand) { return hand.name; }); },
            "The name of the simulated hand; null with any other device."),
        base::computed<C>(
            "operator_toml", [](const C& one) { return one.of_hand(device::print_operator); },
            "Its parameters; likewise."),
        base::computed<C>("duration_s", option<&Options::duration>, "The `--duration`."),
        base::computed<C>(
            "peers", [](const C& one) { return one.options->roster().others; },
            "The ids of the others as `--peer` names them, 0 in a pair."),
        base::computed<C>("wait_for", option<&Options::wait_for>,
                          "How many must be there to start, 0: all."),
        base::computed<C>(
            "tick_ns", [](const C&) { return 1'000'000ULL; }, "The length of a tick."),
        base::computed<C>(
            "wire", [](const C&) { return wire::protocol_version; },
            "The version of the messages."),
        base::computed<C>(
            "boot_id", [](const C&) { return net::boot_id(); },
            "The machine's start; records of one share a clock, [mostly](record.md)."));
}

/// The session with the others. With more than two peers, number and clock belong to each of the
/// others.
struct SessionReport {
    std::optional<std::uint32_t> number;
    std::uint64_t seed = 0;
    Role role = Role::left;
    bool has_joined_late = false;
    std::optional<base::Duration> clock_offset;
    std::optional<base::Duration> clock_uncertainty;
};
constexpr auto fields_of(base::Tag<SessionReport>)
{
    using S = SessionReport;
    return base::fields(
        "session",
        base::member("number", &S::number, "The number of the session; null among more than two."),
        base::member("seed", &S::seed, "The seed that counts."),
        base::member("role", &S::role, "`L` for A, `R` for B."),
        base::member("joined_late", &S::has_joined_late,
                     "Whether this peer came to a session that had begun."),
        base::member("clock_offset_ms", &S::clock_offset,
                     "The other peer's clock minus this one's; null before the first echo, and "
                     "among more than two."),
        base::member("clock_uncertainty_ms", &S::clock_uncertainty, "Its largest possible error."));
}

/// The clock of another peer relative to this one.
struct ClockReport {
    ClockEstimate estimate;
    bool is_in_doubt = false;
    std::uint32_t jumps = 0;
};
constexpr auto fields_of(base::Tag<ClockReport>)
{
    using C = ClockReport;
    return base::fields(
        "clock",
        base::computed<C>(
            "offset_ms", [](const C& clock) { return clock.estimate.offset; },
            "Its clock minus this one's; 0 on one machine."),
        base::computed<C>(
            "uncertainty_ms", [](const C& clock) { return clock.estimate.uncertainty; },
            "The bound of the error: half the shortest round trip of a minute and what the fit may "
            "err by."),
        base::computed<C>(
            "skew_ppm", [](const C& clock) { return clock.estimate.skew_ppm; },
            "By how much its clock runs faster."),
        base::member("in_doubt", &C::is_in_doubt,
                     "Whether nothing is predicted by it [for the "
                     "moment](../design/algorithms.md#dead-reckoning)."),
        base::member("jumps", &C::jumps, "How often it has jumped."));
}

/// The age of the newest state.
struct AgeReport {
    std::optional<base::Duration> mean;
    std::optional<base::Duration> peak_max;
};
constexpr auto fields_of(base::Tag<AgeReport>)
{
    return base::fields("state age", base::member("mean", &AgeReport::mean),
                        base::member("peak_max", &AgeReport::peak_max));
}

/// The state messages to another peer, as far as its echoes give information.
struct PathTimes {
    PathReport measured;

    [[nodiscard]] std::optional<AgeReport> age() const
    {
        if (!measured.age.mean) return std::nullopt;
        return AgeReport{measured.age.mean, measured.age.peak_max};
    }
};
constexpr auto fields_of(base::Tag<PathTimes>)
{
    using P = PathTimes;
    using Times = std::optional<base::MainQuantiles>;
    return base::fields(
        "path times",
        base::computed<P>(
            "delay_ms", [](const P& path) -> Times { return path.measured.delay; },
            "From the sender's stamp to the kernel's receive stamp, while the clock is known and "
            "not in doubt; null before."),
        base::computed<P>(
            "jitter_ms", [](const P& path) -> Times { return path.measured.jitter; },
            "|IPDV| in the order of arrival (RFC 3393), likewise."),
        base::computed<P>(
            "age_ms", [](const P& path) { return path.age(); },
            "The age of the newest state here: its mean over time, and the largest of its peaks."));
}

/// The state messages from another peer since the session with it began.
struct InwardPath {
    base::ArrivalCounts arrived;
    std::optional<double> loss;
    PathTimes times;
};
constexpr auto fields_of(base::Tag<InwardPath>)
{
    return base::fields(
        "inward path", base::part(&InwardPath::arrived),
        base::member("loss", &InwardPath::loss,
                     "Share that is missing up to the highest number received; null when nothing "
                     "was."),
        base::part(&InwardPath::times));
}

[[nodiscard]] std::span<const loop::OtherStatus> others_of(const loop::ServoStatus& status);

/// Returns nullopt for 0, which means that a value is not known yet.
template <typename Number>
[[nodiscard]] constexpr std::optional<Number> unless_0(Number number)
{
    return number != 0 ? std::optional{number} : std::nullopt;
}

/// The report about one of the others.
struct OtherReport {
    const loop::OtherStatus* status = nullptr;

    [[nodiscard]] std::optional<ClockReport> clock() const
    {
        if (!status->clock) return std::nullopt;
        return ClockReport{*status->clock, status->is_clock_in_doubt, status->clock_jumps};
    }
};
constexpr auto fields_of(base::Tag<OtherReport>)
{
    using O = OtherReport;
    return base::fields(
        "other",
        base::computed<O>(
            "id", [](const O& other) { return unless_0(other.status->id); },
            "Its id; null before it answers, unless `--peer` named it."),
        base::computed<O>(
            "session", [](const O& other) { return unless_0(other.status->session); },
            "The number of the session with it; null before."),
        base::computed<O>(
            "heard", [](const O& other) { return other.status->is_heard; },
            "Whether a state of it came within the last 300 ms."),
        base::computed<O>(
            "clock", [](const O& other) { return other.clock(); },
            "Its clock against this one; null before the first echo."),
        base::computed<O>(
            "in",
            [](const O& other) {
                const PathsReport& paths = other.status->paths;
                return InwardPath{paths.arrived, paths.loss, {paths.in}};
            },
            "The state messages from that peer since the session with it began."),
        base::computed<O>(
            "out", [](const O& other) { return PathTimes{other.status->paths.out}; },
            "The state messages to that peer, as far as its echoes tell: of those that were the "
            "newest there when it sent a message that came. The share that was lost is not among "
            "them; it stands in that peer's `in`."),
        base::computed<O>(
            "secure", [](const O& other) -> const auto& { return other.status->line.key; },
            "As `secure` of all, of the line to that peer."));
}

/// Messages, and the outcomes of datagrams at the socket.
struct MessagesReport {
    Counters counters;
    std::uint64_t strangers = 0;
    std::uint64_t overflowed = 0;
    std::uint64_t send_failed = 0;
};
constexpr auto fields_of(base::Tag<MessagesReport>)
{
    using M = MessagesReport;
    return base::fields(
        "messages and datagrams", base::part(&M::counters),
        base::member("strangers", &M::strangers,
                     "Datagrams from any address but those of `--remote` and `--peer`; 0 with a "
                     "key.")
            .counter("hapnet_peer_strangers"),
        base::member("overflowed", &M::overflowed,
                     "Datagrams that the kernel dropped because the loop did not read fast "
                     "enough."),
        base::member("send_failed", &M::send_failed, "Messages that the system did not take.")
            .counter("hapnet_peer_send_failures"));
}

/// The governor, and the other causes for withholding force.
struct ForceReport {
    GovernorFigures governor;
    std::uint64_t watchdog_halts = 0;
    std::uint64_t withheld = 0;
    std::uint64_t unusable_samples = 0;
};
constexpr auto fields_of(base::Tag<ForceReport>)
{
    using F = ForceReport;
    return base::fields(
        "force", base::part(&F::governor),
        base::member("watchdog_halts", &F::watchdog_halts,
                     "Silences of the loop in which the watchdog had to act."),
        base::member("withheld", &F::withheld,
                     "Ticks in which a stop, an emergency stop or a dead man's switch kept all "
                     "force back."),
        base::member("unusable_samples", &F::unusable_samples,
                     "Ticks of a session without a hand in the scene."));
}

/// The energy into the hand.
struct EnergyReport {
    std::uint64_t limited_ticks = 0;
    device::EnergyLimits limits;
    device::EnergyFigures figures;
};
constexpr auto fields_of(base::Tag<EnergyReport>)
{
    using E = EnergyReport;
    return base::fields(
        "energy",
        base::member("limited_ticks", &E::limited_ticks,
                     "Ticks in which the [energy into the "
                     "hand](../design/governor.md#the-energy-into-the-hand) was limited; a run in "
                     "which it is not 0 says so on stderr, too."),
        base::computed<E>(
            "power_limit_w", [](const E& energy) { return energy.limits.power_max_w; },
            "The limit that holds."),
        base::computed<E>(
            "work_5s_limit_j", [](const E& energy) { return energy.limits.work_max_j; },
            "The limit that holds."),
        base::part(&E::figures));
}

/// All statistics of a peer.
struct PeerStatistics {
    PeerConfiguration configuration;
    std::optional<SessionReport> session;
    std::vector<OtherReport> others;
    std::optional<line::Status::Key> secure;
    TickReport tick;
    MessagesReport messages;
    ForceReport governor;
    std::optional<EnergyReport> energy;
    std::uint64_t record_rows_lost = 0;
    std::uint64_t texts_lost = 0;
    std::optional<bool> is_record_whole;
    std::optional<bool> are_events_whole;
    net::RealTime real_time;
    std::optional<std::string_view> refusal;
    bool is_valid = false;
    std::optional<base::Duration> elapsed;
};
constexpr auto fields_of(base::Tag<PeerStatistics>)
{
    using S = PeerStatistics;
    return base::fields(
        "peer", base::part(&S::configuration),
        base::member("session", &S::session, "null before the start is agreed."),
        base::member("others", &S::others,
                     "One object for each other peer, in the order of their ids. Of a pair it has "
                     "one."),
        base::member("secure", &S::secure,
                     "null without a key; among more than two the sums of all, and of times the "
                     "longest. Datagrams that were refused here are not counted under `messages`."),
        base::member("tick", &S::tick, "The ticks of the haptic loop."),
        base::member("messages", &S::messages, "What came from the others, and what went."),
        base::member("governor", &S::governor, "What stands between the scene and the motors."),
        base::member("energy", &S::energy,
                     "The energy into the hand; null where it is not limited."),
        base::member("record_rows_lost", &S::record_rows_lost,
                     "Rows that are missing in the record: the disk was too slow or full. Also "
                     "datagrams of a flood that had no effect: beyond 2000 a second they are left "
                     "out; and messages longer than any of the scene."),
        base::member("texts_lost", &S::texts_lost,
                     "Messages on stdout and stderr that found no room, as the others were not "
                     "read."),
        base::member("record_whole", &S::is_record_whole,
                     "Whether the record could be written to its end; null without `--record`."),
        base::member("events_whole", &S::are_events_whole,
                     "Whether no event was lost so far; null without `--events`."),
        base::member("real_time", &S::real_time, "What the system granted."),
        base::member("refusal", &S::refusal,
                     "Why these peers cannot play together, in words; null if they can."),
        base::member("valid", &S::is_valid, "Whether the run is [valid](#what-valid-means)."),
        base::member("elapsed_s", &S::elapsed,
                     "While the run lasts: the time since its first tick.")
            .gauge("hapnet_peer_elapsed")
            .left_out_if_none());
}
/// Returns the statistics, which refer to parts of `run`.
[[nodiscard]] PeerStatistics statistics_of(const Run& run);

/// Returns why the run is not valid as a measurement; "" if it is.
[[nodiscard]] std::string why_not_valid(const Run& run);

/// Returns the text of a refusal, with what to do about it.
[[nodiscard]] std::string_view describe(wire::ByeReason reason);

} // namespace hapnet::peer::monitor

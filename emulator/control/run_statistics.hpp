// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/change_log.hpp"
#include "emulator/core/direction_report.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/time.hpp"
#include "proto/base/value_kind.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

// The statistics that --stats writes and `stats` answers: docs/formats/statistics.md. Keys that a
// kind of run does not have are left out.

/// The conditions of a path that differ from the default, as a profile writes them.
struct Configuration {
    base::Entries<std::string> up;
    base::Entries<std::string> down;
};
constexpr auto fields_of(base::Tag<Configuration>)
{
    return base::fields("configuration", base::member("up", &Configuration::up),
                        base::member("down", &Configuration::down));
}

/// The numbers of the first datagrams, up and down, for which a change is in effect.
struct FirstDatagrams {
    std::uint64_t up = 0;
    std::uint64_t down = 0;
};
constexpr auto fields_of(base::Tag<FirstDatagrams>)
{
    return base::fields("first datagrams", base::member("up", &FirstDatagrams::up),
                        base::member("down", &FirstDatagrams::down));
}

/// A change of the conditions.
struct ChangeReport {
    std::optional<std::uint64_t> generation{};
    base::Duration elapsed{};
    FirstDatagrams effective_at{};
    ChangeCause by{};
    base::Entries<std::string> settings;
};
constexpr auto fields_of(base::Tag<ChangeReport>)
{
    using C = ChangeReport;
    return base::fields(
        "change",
        base::member("generation", &C::generation,
                     "The generation from this change on; only where the run has one path.")
            .left_out_if_none(),
        base::member("elapsed_s", &C::elapsed, "Its time since the start of the run."),
        base::member("effective_at", &C::effective_at,
                     "Number of the first datagram of each direction for which it holds, from 0."),
        base::member("by", &C::by,
                     "`hand`: a `set`, `apply` or `reset` of `hapnet-ctl`, or the end of a setting "
                     "made for a time. `timeline`: the profile. `reload`: SIGHUP."),
        base::member("settings", &C::settings,
                     "The settings that changed and their new values, by the keys of a profile "
                     "(`up.delay`); empty where another profile changed none."));
}

/// The conditions of a path during a run, and their changes.
struct CourseReport {
    Configuration at_start;
    std::optional<Configuration> at_end;
    std::optional<std::vector<ChangeReport>> changes;
    std::optional<std::uint64_t> changes_omitted;
};
constexpr auto fields_of(base::Tag<CourseReport>)
{
    using C = CourseReport;
    return base::fields(
        "course",
        base::member("configuration_at_start", &C::at_start,
                     "The conditions at the start that are not the default, each as a profile "
                     "writes it."),
        base::member("configuration_at_end", &C::at_end,
                     "Those at the end, or at this moment of a run that goes on.")
            .left_out_if_none(),
        base::member("changes", &C::changes,
                     "The [changes of the conditions](#changes-of-the-conditions), in their order.")
            .left_out_if_none(),
        base::member("changes_omitted", &C::changes_omitted,
                     "Changes that are not in the list: beyond the thousandth, and while the run "
                     "lasts all but the newest 20.")
            .left_out_if_none());
}

/// The report on a flow, or on the traffic that is in no flow.
struct FlowReport {
    CourseReport course;
    DirectionReport up;
    DirectionReport down;
};
constexpr auto fields_of(base::Tag<FlowReport>)
{
    using F = FlowReport;
    return base::fields("flow", base::part(&F::course),
                        base::member("up", &F::up, "From A to B.").label("direction"),
                        base::member("down", &F::down, "From B to A.").label("direction"));
}

/// Reports on flows by their names. The traffic that is in no flow is last.
using FlowReports = base::Entries<FlowReport>;

/// The report on a client of a server.
struct ClientReport {
    std::uint64_t number = 0;
    std::string name;
    std::string address;
    CourseReport course;
    DirectionReport up;
    DirectionReport down;
    std::optional<FlowReports> flows{};
};
constexpr auto fields_of(base::Tag<ClientReport>)
{
    using C = ClientReport;
    return base::fields(
        "client", base::member("client", &C::number, "The number n of its streams."),
        base::member("name", &C::name, "The name of its path."),
        base::member("address", &C::address), base::part(&C::course),
        base::member("up", &C::up, "From the client."),
        base::member("down", &C::down, "To the client."),
        base::member("flows", &C::flows, "In a run with flows: see there.").left_out_if_none());
}

/// Addresses of the two ends of a link of datagrams, and the emulator's addresses toward them.
struct LinkEnds {
    std::optional<std::string> listen_1{};
    std::optional<std::string> listen_2{};
    std::optional<std::optional<std::string>> end_1{}; // inner nullopt: not known yet
    std::optional<std::optional<std::string>> end_2{};
};
constexpr auto fields_of(base::Tag<LinkEnds>)
{
    using L = LinkEnds;
    return base::fields(
        "link ends",
        base::member("listen_1", &L::listen_1,
                     "With `--link`: the emulator's address towards A, its first end.")
            .left_out_if_none(),
        base::member("listen_2", &L::listen_2, "With `--link`: that towards B, its second end.")
            .left_out_if_none(),
        base::member("end_1", &L::end_1, "With `--link`: A; null while it is not known.")
            .left_out_if_none(),
        base::member("end_2", &L::end_2, "With `--link`: B; null while it is not known.")
            .left_out_if_none());
}

/// The report on one of several links.
struct LinkReport {
    LinkEnds ends;
    CourseReport course;
    DirectionReport up;
    DirectionReport down;
    std::optional<FlowReports> flows{};
};
constexpr auto fields_of(base::Tag<LinkReport>)
{
    using L = LinkReport;
    return base::fields("link", base::part(&L::ends), base::part(&L::course),
                        base::member("up", &L::up, "From A to B.").label("direction"),
                        base::member("down", &L::down, "From B to A.").label("direction"),
                        base::member("flows", &L::flows, "In a run with flows: see there.")
                            .label("flow")
                            .left_out_if_none());
}

/// The counters of a network interface. They do not include the counters of its path.
struct InterfaceReport {
    std::string interface;
    std::uint64_t undisturbed = 0;
    std::uint64_t not_ip = 0;
    std::uint64_t oversized = 0;
    std::uint64_t lost_undisturbed = 0;
    std::uint64_t told_too_big = 0;
    std::optional<std::uint64_t> overflowed{};
};
constexpr auto fields_of(base::Tag<InterfaceReport>)
{
    using I = InterfaceReport;
    return base::fields(
        "interface", base::member("interface", &I::interface, "Its name."),
        base::member("undisturbed", &I::undisturbed,
                     "Frames that passed without conditions, such as those of ARP."),
        base::member("not_ip", &I::not_ip, "Of these, those that carry no IP."),
        base::member("oversized", &I::oversized, "Frames longer than the MTU of the way out."),
        base::member("lost_undisturbed", &I::lost_undisturbed,
                     "Of the undisturbed ones, those that the system did not take."),
        base::member("told_too_big", &I::told_too_big,
                     "Senders that were told that their packets are too big."),
        base::member("overflowed", &I::overflowed,
                     "With three commands or more: frames that the kernel dropped because the "
                     "emulator did not read fast enough, whichever way they would have taken. "
                     "Between two ends, `overflowed` of the direction has them.")
            .left_out_if_none());
}

/// The interfaces of a run between interfaces, by their names.
using InterfaceReports = base::Entries<InterfaceReport>;

/// The privileges for punctual sending that the system granted.
struct RealTimeReport {
    bool fifo = false;
    bool locked_memory = false;
};
constexpr auto fields_of(base::Tag<RealTimeReport>)
{
    return base::fields(
        "real time",
        base::member("fifo", &RealTimeReport::fifo, "Whether the system granted SCHED_FIFO."),
        base::member("locked_memory", &RealTimeReport::locked_memory,
                     "Whether it granted locked memory."));
}

/// The result of a check.
struct CheckReport {
    std::string require;
    std::optional<double> value;
    bool is_met = false;
};
constexpr auto fields_of(base::Tag<CheckReport>)
{
    return base::fields(
        "check", base::member("require", &CheckReport::require, "The condition."),
        base::member("value", &CheckReport::value, "The value of its key; null where it has none."),
        base::member("met", &CheckReport::is_met, "Whether it holds."));
}

/// The report on the program and its mode of operation.
struct ProgramReport {
    std::string_view program = "hapnet-emulator";
    std::string_view version;
    std::string_view commit;
    std::string_view compiler;
    std::uint64_t seed = 0;
    std::string_view timing;
    base::Duration budget{};
    base::Duration duration{};
    RealTimeReport real_time{};
};
constexpr auto fields_of(base::Tag<ProgramReport>)
{
    using P = ProgramReport;
    return base::fields("program", base::member("program", &P::program, "The program that ran."),
                        base::member("version", &P::version, "Its version."),
                        base::member("commit", &P::commit, "The commit that it was built from."),
                        base::member("compiler", &P::compiler, "What it was built with."),
                        base::member("seed", &P::seed, "The seed of the run."),
                        base::member("timing", &P::timing, "`eco`, `precise` or `spin`."),
                        base::member("budget_us", &P::budget, "The `--budget`."),
                        base::member("duration_s", &P::duration, "Length of the run so far."),
                        base::member("real_time", &P::real_time));
}

/// The two ends of a run: commands, interfaces or addresses.
struct EndsReport {
    std::optional<std::string> command{};
    std::optional<std::string> through{};
    std::optional<InterfaceReports> frames{};
    std::optional<std::string> listen_a{};
    std::optional<std::string> listen_b{};
    std::optional<std::optional<std::string>> a{}; // inner nullopt: not known yet
    std::optional<std::optional<std::string>> b{};
    std::optional<std::uint64_t> strangers{};
    std::optional<std::uint64_t> overflowed{};
    std::optional<std::string> listen{};
    std::optional<std::string> upstream{};
    std::optional<std::uint64_t> clients_seen{};
    std::optional<std::uint64_t> clients_forgotten{};
    std::optional<std::uint64_t> refused{};
};
constexpr auto fields_of(base::Tag<EndsReport>)
{
    using E = EndsReport;
    return base::fields(
        "ends",
        base::member("command", &E::command,
                     "Only with [`between`, `exec` and "
                     "`bridge`](../use/between.md#what-the-conditions-hold-for): which of them.")
            .left_out_if_none(),
        base::member("through", &E::through,
                     "Only with [`exec`](../use/exec.md#what-stands-behind-it): `pasta` or "
                     "`slirp4netns`.")
            .left_out_if_none(),
        base::member("frames", &E::frames,
                     "Only with [`between`, `exec` and "
                     "`bridge`](../use/between.md#what-the-conditions-hold-for): what each "
                     "interface passed on besides.")
            .left_out_if_none(),
        base::member("listen_a", &E::listen_a,
                     "The emulator's own address towards A, with the port that port 0 became.")
            .left_out_if_none(),
        base::member("listen_b", &E::listen_b, "That towards B.").left_out_if_none(),
        base::member("a", &E::a, "The address of A; null until the first sender was adopted.")
            .left_out_if_none(),
        base::member("b", &E::b, "That of B.").left_out_if_none(),
        base::member("strangers", &E::strangers, "Of both directions, see below.")
            .left_out_if_none(),
        base::member("overflowed", &E::overflowed, "Of both directions, see below.")
            .left_out_if_none(),
        base::member("listen", &E::listen,
                     "With `--upstream`: the emulator's own address towards the clients.")
            .left_out_if_none(),
        base::member("upstream", &E::upstream, "With `--upstream`: the server.").left_out_if_none(),
        base::member("clients_seen", &E::clients_seen, "Clients since the start.")
            .left_out_if_none(),
        base::member("clients_forgotten", &E::clients_forgotten,
                     "Those of them that were silent for `--idle`.")
            .left_out_if_none(),
        base::member("refused", &E::refused, "Datagrams for whose sender there was no place.")
            .left_out_if_none());
}

/// The profile and the files of a run.
struct FilesReport {
    std::string profile;
    std::optional<std::string> fates;
    std::optional<std::string> replay;
    std::optional<std::string> capture;
    std::uint64_t fates_lost = 0;
    std::uint64_t capture_lost = 0;
};
constexpr auto fields_of(base::Tag<FilesReport>)
{
    using F = FilesReport;
    return base::fields(
        "files",
        base::member("profile", &F::profile,
                     "The whole profile of the start with its timeline, as TOML."),
        base::member("fates", &F::fates, "The file of `--fates`; null without the option."),
        base::member("replay", &F::replay, "The file of `--replay`; null without the option."),
        base::member("capture", &F::capture, "The file of `--pcap`; null without the option."),
        base::member("fates_lost", &F::fates_lost,
                     "Datagrams missing in the file of `--fates`, because the disk was too slow or "
                     "full."),
        base::member("capture_lost", &F::capture_lost,
                     "Packets missing in the file of `--pcap`, for the same reasons."));
}

struct RunStatistics {
    ProgramReport program{};
    EndsReport ends{};
    std::uint64_t generation = 1;
    CourseReport course;
    FilesReport files{};
    bool is_valid = false;
    std::vector<std::string> invalid_because;
    DirectionReport up;
    DirectionReport down;
    std::optional<base::Entries<LinkReport>> links{};
    std::optional<std::vector<ClientReport>> clients{};
    std::optional<FlowReports> flows{};
    std::optional<std::uint64_t> unknown_fragments{};
    std::optional<base::Duration> elapsed{};
    std::vector<CheckReport> checks;
};
constexpr auto fields_of(base::Tag<RunStatistics>)
{
    using S = RunStatistics;
    return base::fields(
        "run", base::part(&S::program), base::part(&S::ends),
        base::member("generation", &S::generation,
                     "1, and one more for each change of the conditions.")
            .gauge("hapnet_emulator_generation"),
        base::part(&S::course), base::part(&S::files),
        base::member("valid", &S::is_valid, "Whether the run is [valid](#what-valid-means)."),
        base::member("invalid_because", &S::invalid_because,
                     "The reasons as a list of texts, those of a direction or of files with `up:`, "
                     "`down:` or `files:` before them; empty when valid."),
        base::member("up", &S::up, "A to B, with the keys of the next tables.").label("direction"),
        base::member("down", &S::down, "B to A, with the same keys.").label("direction"),
        base::member("links", &S::links,
                     "With `--link`, and of three commands or more of `between`: each link by its "
                     "name. `up` and `down` of the run are then their sums, without `lens`.")
            .label("path")
            .left_out_if_none(),
        base::member("clients", &S::clients,
                     "With `--upstream`: the clients at present. `up` and `down` of the run are "
                     "then sums over all, also over those that were forgotten, without `lens`.")
            .left_out_if_none(),
        base::member("flows", &S::flows,
                     "With [`[[flow]]`](profile.md#flows): each flow by its name, and `rest`, what "
                     "belongs to none. `up` and `down` are then their sums, without `lens`. Where "
                     "there are several paths, each has its flows, and these are the sums of all.")
            .label("flow")
            .left_out_if_none(),
        base::member("unknown_fragments", &S::unknown_fragments,
                     "With flows: later fragments of packets whose first one did not come before.")
            .left_out_if_none(),
        base::member("elapsed_s", &S::elapsed, "While the run lasts: the time since its start.")
            .gauge("hapnet_emulator_elapsed")
            .left_out_if_none(),
        base::member("checks", &S::checks,
                     "Only in a run with `--require` or [`[[check]]`](profile.md#checks): what "
                     "became of each, as it is at this moment.")
            .left_out_if_none());
}

} // namespace hapnet::emulator

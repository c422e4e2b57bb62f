// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/file_options.hpp"

#include "emulator/core/flow/flow.hpp"
#include "emulator/core/path_name.hpp"
#include "proto/cli/parsers.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

constexpr const char* verify_description =
    "Tests whether the fates of a run follow its profile: shares, runs and bursts of losses, the "
    "steps of their chains, delays, the two directions against each other and, with the seed, "
    "every single fate.";

constexpr const char* verify_footer =
    R"(RUN is the file that --stats wrote in a run with --fates, the file that --fates wrote, with
--profile, or a folder with fates.csv and profile.toml. A test fails when a run that follows its
profile would look like this one time in a million. A test cannot tell ("unable" in JSON) where the
datagrams are too few, or where fates do not show it. A run with --replay is refused, and one whose
conditions changed, by hand or by the timeline.

Examples:
  hapnet-emulator verify run.json
  hapnet-emulator verify fates.csv --profile wifi-busy --seed 42 --rate 1000
  hapnet-emulator verify results/run-7 --json)";

constexpr const char* verify_exit_codes = R"(  0  no test failed
  1  a test failed
  2  bad usage, or a file that cannot be used)";

constexpr const char* learn_description =
    "Finds the laws of a measured path, delay, correlation in time and loss, and prints a profile "
    "that follows them. How well each law fits, and how well what is learned from the first half "
    "does for the second, is told on stderr and in comments of the profile.";

constexpr const char* learn_footer =
    R"(FILE is one of these:
  ping       what ping has printed, in any language: iputils, BusyBox, BSD, macOS,
             Windows; or fping. What has no answer is lost
  probe      what hapnet-emulator probe --csv has written
  irtt       the JSON of irtt client -o FILE.json
  table      a column of delays, delay_ns, _us, _ms or _s, empty for a lost
             datagram, and perhaps one of times; commas, semicolons, tabs or
             blanks separate, quotes and decimal commas are read
  capture    pcap or pcapng. Two, from both ends of the path, measure each way:
             up is from the first to the second. One measures round trips, of
             ping and of what comes back unchanged; one with two interfaces, as
             --pcap writes it, each way between them
Several files are one measurement after the other of the same path. A round trip
does not tell its two ways apart: all that varies is put into the way down. Where
no law gives the delays that were measured, the profile draws them from FILE, if
that is a table, or replays it. On a terminal, delays and losses are drawn beside
the law that was taken.

Examples:
  ping -i 0.2 -c 5000 example.org > ping.txt
  hapnet-emulator learn ping.txt > home.toml
  hapnet-emulator learn here.pcapng there.pcapng > path.toml
  hapnet-emulator learn monday.json tuesday.json > week.toml
  hapnet-emulator learn walk.csv --columns "time=stamp:s, delay=rtt:ms"
  hapnet-emulator learn ping.txt --trace pings.csv > as-it-was.toml)";

constexpr const char* learn_exit_codes = R"(  0  done
  2  bad usage, or a file that cannot be used
  3  the file of --trace cannot be written)";

constexpr const char* report_description =
    "Makes one page of a run, for a browser: delay as drawn and as it came out, lateness, losses, "
    "changes, and the tests of verify.";

constexpr const char* report_footer =
    R"(RUN is the file that --stats wrote. With --fates in that run, the page has plots.

Examples:
  hapnet-emulator --listen-a :7001 --listen-b :7002 --profile lte \
      --duration 30s --stats run.json --fates fates.csv
  hapnet-emulator report run.json --out run.html)";

constexpr const char* report_exit_codes = R"(  0  done
  2  bad usage, or a file that cannot be used
  3  the page cannot be written)";

base::Result<base::Duration> parse_even_spacing(const std::string& text)
{
    constexpr std::uint64_t most = 1'000'000'000;
    return cli::value_of<std::uint64_t>(base::Count{1, most}, text).map([](std::uint64_t rate) {
        return base::Duration{static_cast<base::Duration::rep>(most / rate)};
    });
}

void add_link(cli::Command& command, std::optional<std::string>& link)
{
    command.option("--link", "NAME", "Which path of a run with several: 1-2, wan, or client.3",
                   [&link](const std::string& text) -> base::Result<void> {
                       link = flow_path(text, parts_of(link.value_or("")).flow);
                       return {};
                   });
    command.option("--flow", "NAME", "Which flow of a run with flows (default: the rest)",
                   [&link](const std::string& text) -> base::Result<void> {
                       const bool is_rest = text == rest_of_flows;
                       const auto path =
                           flow_path(parts_of(link.value_or("")).path, is_rest ? "" : text);
                       if (link || !path.empty()) link = path;
                       return {};
                   });
}

} // namespace

cli::Command& add_verify(cli::Command& program, VerifyOptions& options)
{
    cli::Command& command =
        program.command("verify", "Tests whether the fates of a run follow its profile");
    command.describe(verify_description);
    command.add_footer(verify_footer);
    command.add_exit_codes(verify_exit_codes);
    command.positional("RUN", "What a run has written", cli::into(options.run))
        .required("run.json");
    command.option("--profile", "FILE|NAME",
                   "The profile that the run was to follow (default: the one in RUN)",
                   cli::into(options.profile));
    add_link(command, options.link);
    command.option("--seed", "NUMBER", "The seed of the run (default: the one in the profile)",
                   cli::into(options.seed, cli::seed));
    command.option("--rate", "NUMBER",
                   "Datagrams a second in each direction, where they came evenly: needed by laws "
                   "in time",
                   cli::into(options.spacing, parse_even_spacing));
    command.flag("--json", "Print one JSON object instead of a table", options.as_json);
    return command;
}

cli::Command& add_learn(cli::Command& program, LearnOptions& options)
{
    cli::Command& command = program.command("learn", "Finds the profile of a measured path");
    command.describe(learn_description);
    command.add_footer(learn_footer);
    command.add_exit_codes(learn_exit_codes);
    command.positional("FILE", "What was measured; may be repeated", cli::onto(options.files))
        .repeated()
        .required("ping.txt");
    command.option("--columns", "COLUMNS",
                   "Columns of a table with other names, or by number where it has no "
                   "header: \"delay=rtt:ms\", \"time=1:s, delay=2:ms\"",
                   cli::into(options.columns));
    command.option("--spacing", "TIME",
                   "Time from one datagram that was sent to the next, where FILE does not say so",
                   cli::into(options.spacing, base::Time{std::chrono::microseconds{1}}));
    command.option("--rate", "NUMBER", "The same as a number of datagrams a second",
                   cli::into(options.spacing, parse_even_spacing));
    command.flag("--one-way", "A table has the delays of one way, from A to B, not round trips",
                 options.is_one_way);
    command.option("--trace", "FILE",
                   "Write delays and losses as they were measured to FILE, and print a profile "
                   "that replays it; of two ways to FILE-up and FILE-down",
                   cli::into(options.trace));
    command.flag("--json", "Print one JSON object with the profile and how well it fits",
                 options.as_json);
    command.flag("--plot", "Draw delays and losses on stderr, also where it is no terminal",
                 options.with_plots);
    return command;
}

cli::Command& add_report(cli::Command& program, ReportOptions& options)
{
    cli::Command& command = program.command("report", "Makes a page of a run");
    command.describe(report_description);
    command.add_footer(report_footer);
    command.add_exit_codes(report_exit_codes);
    command.positional("RUN", "What --stats of the run has written", cli::into(options.run))
        .required("run.json");
    command.option("--fates", "FILE", "The fates of the run (default: those that RUN names)",
                   cli::into(options.fates));
    add_link(command, options.link);
    command.option("--out", "FILE", "Where the page goes; - is stdout", cli::into(options.out))
        .required("run.html");
    return command;
}

} // namespace hapnet::emulator

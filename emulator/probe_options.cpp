// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/probe_options.hpp"

#include "emulator/spacing.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

constexpr const char* probe_description =
    "A ping for UDP. Asks a program that answers, which is this command with --answer, and prints "
    "how long each answer took. At the end, or when it is stopped, it prints what was lost and how "
    "long the ways took: each way by itself where both ends are on one machine, which has one "
    "clock.";

constexpr const char* probe_footer =
    R"(The round trip leaves out the time that the answering program took; arrivals are the kernel's
receive stamps. "there" is from the asking program to the answering one, "back" is the answer's way.

Examples:
  hapnet-emulator probe --answer 7002
  hapnet-emulator probe 127.0.0.1:7002 --count 10
  hapnet-emulator probe --answer 0.0.0.0:7002
  hapnet-emulator probe 10.0.0.5:7002 --rate 1000 --count 10000 --csv probe.csv)";

constexpr const char* probe_exit_codes = R"(  0  an answer came; with --answer: stopped
  1  no answer came
  2  bad usage
  3  the system refused (port in use, no route))";

base::Result<net::HostPort> parse_target(const std::string& text)
{
    auto host = net::parse_listen_address(text); // a port without an address: loopback
    if (host && host->port == 0) {
        return base::fail(fmt::format("'{}': nothing can be sent to port 0", text));
    }
    return host;
}

base::Result<base::Duration> parse_probe_rate(const std::string& text)
{
    return parse_spacing(text, "questions", 5);
}

} // namespace

cli::Command& add_probe(cli::Command& program, ProbeOptions& options)
{
    cli::Command& command =
        program.command("probe", "Measures delay and loss of a path, as ping does, with UDP");
    command.describe(probe_description);
    command.add_footer(probe_footer);
    command.add_exit_codes(probe_exit_codes);
    command.positional("HOST:PORT", "Where a probe --answer listens, or a relay to it",
                       cli::into(options.target, parse_target));
    command.option("--answer", "ADDRESS",
                   "Answer instead of asking: HOST:PORT to listen on; a bare port is one of "
                   "loopback, 0.0.0.0:PORT answers other machines",
                   cli::into(options.answer, net::parse_listen_address));
    command.option("--rate", "NUMBER", "Questions a second (default 10)",
                   cli::into(options.spacing, parse_probe_rate));
    command.option("--count", "NUMBER",
                   "End after this many questions (default: ask until stopped)",
                   cli::into(options.count, base::Count{1, tools::ProbeStatistics::questions_max}));
    command.option("--size", "NUMBER",
                   fmt::format("Payload of a question and of its answer, in bytes: {} to {} "
                               "(default 136: a state of a hand and a cube)",
                               tools::ProbeMessage::bytes_min, tools::ProbeMessage::bytes_max),
                   cli::into(options.bytes, base::Count{tools::ProbeMessage::bytes_min,
                                                        tools::ProbeMessage::bytes_max}));
    command.option("--wait", "TIME",
                   "How long to wait for answers after the last question (default 2s). Once an "
                   "answer has come, twice the longest round trip is enough",
                   cli::into(options.wait, base::Time{}));
    command.option("--csv", "FILE", "Write a line for each question to FILE",
                   cli::into(options.csv));
    command.flag("--json", "Print one JSON object instead of lines and a table", options.as_json);
    command.flag("-q,--quiet", "Print no line for each answer", options.is_quiet);
    return command;
}

base::Result<void> require_probe(const ProbeOptions& options, const cli::Command& command)
{
    if (!options.target && !options.answer) {
        return base::fail("HOST:PORT is required: hapnet-emulator probe 127.0.0.1:7002; on the "
                          "other side hapnet-emulator probe --answer 7002");
    }
    if (!options.answer) return {};
    if (options.target) {
        return base::fail("--answer and HOST:PORT exclude each other: one end asks, the other "
                          "answers");
    }
    for (const char* option : {"--rate", "--count", "--size", "--wait", "--csv", "--json"}) {
        if (!command.is_given(option)) continue;
        return base::fail(fmt::format("{} is for the end that asks, and --answer answers", option));
    }
    return {};
}

} // namespace hapnet::emulator

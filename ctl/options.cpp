// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "ctl/options.hpp"

#include "proto/base/quantity.hpp"
#include "proto/cli/command.hpp"

#include <chrono>
#include <iterator>
#include <spdlog/fmt/fmt.h>

namespace hapnet::ctl {

namespace {

constexpr const char* description =
    "Shows the state of a running hapnet-emulator or hapnet-peer, changes an emulator, and stops "
    "either.";

constexpr base::Duration longest{std::chrono::hours{24}}; // limit of times at the control socket

constexpr const char* footer =
    R"(SOCKET is the path that the program was given as --control. Without it $HAPNET_SOCKET counts.

Keys are those of a profile: up.delay holds from A to B, down.delay from B to A, both.delay or plain
delay both ways. Times need a unit (ns us ms s min h), shares a %. A change takes effect between two
datagrams; the answer names the first datagram of each direction that it holds for. A setting holds
until the timeline of the profile changes the same key. With --for it ends by itself, even if
hapnet-ctl is gone by then. Files that a setting or a profile names are sent along, from here or
from beside the profile.

A peer answers show, stats, metrics, watch, wait, keep, stop and estop. Its settings cannot be
changed while it runs.

Examples:
  hapnet-ctl /tmp/emulator.sock show
  hapnet-ctl /tmp/emulator.sock set both.delay 80ms both.loss 1%
  hapnet-ctl /tmp/emulator.sock set up.loss=100% --for 30s
  hapnet-ctl /tmp/emulator.sock show > now.toml
  hapnet-ctl /tmp/emulator.sock diff now.toml
  hapnet-ctl /tmp/emulator.sock apply now.toml
  hapnet-ctl /tmp/emulator.sock apply lte
  hapnet-ctl /tmp/emulator.sock wait --until 'up.received>1000' --timeout 10s
  hapnet-ctl /tmp/emulator.sock stats
  hapnet-ctl /tmp/peer.sock wait --until 'messages.states_received>0'
  export HAPNET_SOCKET=/tmp/peer.sock; hapnet-ctl watch
  hapnet-ctl watch --frames --every 16ms
  hapnet-ctl /tmp/peer.sock keep before-the-crash --last 10s
  hapnet-ctl /tmp/peer.sock stop)";

constexpr const char* set_footer =
    R"(A key is up.NAME (from A to B), down.NAME (from B to A), or both.NAME or NAME (both ways).
NAME is one of mtu, rate, queue, loss, burst_loss, corrupt, duplicate, delay, jitter,
correlation_time, order and reorder; burst_loss may be written burst-loss. regime.R. before NAME
makes it one of the regime R: up.regime.bad.delay. KEY=VALUE is the same as KEY VALUE.
Units are mandatory, without a space: ns us ms s min h for times, % for shares, B KiB for sizes,
kbit/s Mbit/s for rates.
A law is written as a table, as in a profile.

Examples:
  hapnet-ctl /tmp/emulator.sock set both.delay 80ms down.loss=1%
  hapnet-ctl /tmp/emulator.sock set up.loss '{ law = "every", every = 100 }'
  hapnet-ctl /tmp/emulator.sock set up.loss 100% --for 30s)";

constexpr const char* exit_codes = R"(  0  done
  1  the condition was not met in time, or the program ended
  2  bad usage, or refused by the program
  3  no program answers on the socket)";

using Words = std::vector<std::string>;

/// Parses alternating keys and values: "both.delay 80ms", or "both.delay=80ms".
base::Result<void> take_settings(const Words& words, Options& options)
{
    for (auto word = words.begin(); word != words.end(); ++word) {
        const std::string& key = *word;
        if (!options.settings.empty() && base::is_unit(key)) {
            const auto& [last, number] = options.settings.back();
            return base::fail(fmt::format(
                "'{0}' is not a setting: write {1} {2}{0}, without a space", key, last, number));
        }
        const auto sign = key.find('=');
        if (sign != std::string::npos && sign > 0 && sign + 1 < key.size()) {
            options.settings.emplace_back(key.substr(0, sign), key.substr(sign + 1));
            continue;
        }
        const bool is_open = sign != std::string::npos && sign > 0; // "up.delay="
        const auto next = std::next(word);
        if (next != words.end() && (is_open || next->starts_with('='))) {
            const auto value = *next == "=" && std::next(next) != words.end() ? *std::next(next)
                               : next->starts_with('=')                       ? next->substr(1)
                                                                              : *next;
            return base::fail(fmt::format("write {}={}, without a space", key.substr(0, sign),
                                          value.empty() ? "VALUE" : value));
        }
        if (is_open || next == words.end()) {
            return base::fail(
                fmt::format("'{}' has no value: write set {} VALUE", key, key.substr(0, sign)));
        }
        options.settings.emplace_back(key, *next);
        word = next;
    }
    return {};
}

void add_commands(cli::Command& program, Options& options, Words& settings)
{
    program.command("show", "Prints the conditions that hold now and the rest of the timeline, "
                            "as a profile; of a peer its settings and state");
    cli::Command& set = program.command("set", "Changes settings of an emulator");
    set.positional("KEY VALUE", "A setting and its new value, such as both.delay 80ms",
                   cli::onto(settings))
        .repeated()
        .required("both.delay 80ms");
    set.option("--for", "TIME", "Hold for this time, then return to what holds without it",
               cli::into(options.lasting, base::Time{std::chrono::milliseconds{1}, longest}));
    set.add_footer(set_footer);
    cli::Command& apply = program.command("apply", "Replaces the profile of an emulator; its "
                                                   "timeline starts now");
    cli::Command& diff = program.command("diff", "Prints what apply would change");
    for (cli::Command* command : {&apply, &diff}) {
        command
            ->positional("FILE",
                         "A profile: a file, or the name of a preset; - reads it from stdin",
                         cli::into(options.file))
            .required("now.toml");
    }
    program.command("reset", "Undoes every set and apply of an emulator: back to the profile "
                             "that it was started with, at the present position of its timeline");
    program.command("stats", "Prints the statistics, as --stats of the program writes them")
        .flag("--csv", "Print a line for each figure: its key and its value", options.as_csv);
    program.command("metrics", "Prints the main figures of the statistics as text for Prometheus");
    cli::Command& watch = program.command("watch", "Prints the main figures until Ctrl-C: in place "
                                                   "on a terminal, otherwise a line each time");
    watch.option("--every", "TIME",
                 "The interval, at least 50ms (default 500ms); of frames 10ms to 1s of a peer and "
                 "20ms to 1s of an emulator (default 20ms)",
                 cli::into(options.every, base::Time{std::chrono::milliseconds{10}, longest}));
    watch.flag("--frames", "Print frames: short lines of JSON with what is newest",
               options.of_frames);
    cli::Command& wait = program.command("wait", "Waits until a condition holds");
    wait.option("--until", "CONDITION",
                "A key of stats, one of < <= == != >= >, and a number, true or false",
                cli::into(options.until))
        .required("'up.received>1000'");
    wait.option("--timeout", "TIME", "Give up after this time, with exit code 1",
                cli::into(options.timeout, base::Time{base::Duration{0}, longest}));
    cli::Command& keep = program.command("keep", "Saves what happened last, of a program that was "
                                                 "started with --keep: a capture or a record");
    keep.positional("NAME", "What to call it: a-z, 0-9 and -", cli::into(options.name))
        .required("trap-1");
    keep.option("--last", "TIME", "How much of it (default: all that is held)",
                cli::into(options.last, base::Time{std::chrono::milliseconds{1}, longest}));
    program.command("stop", "Ends the program as SIGTERM does: a peer with zero force, an "
                            "emulator with its files written");
    program.command("estop", "Emergency stop: ends the force of a peer at once, until the peer is "
                             "started anew; its session goes on without");
}

} // namespace

net::CommandLine<Options> parse_options(std::span<char*> words, const char* default_socket)
{
    Options options;
    Words settings;
    std::string named;
    cli::Command program{"hapnet-ctl", description};
    program.add_footer(footer);
    program.add_exit_codes(exit_codes);
    program.require_command();
    program.positional("SOCKET", "The path that the program was given as --control",
                       cli::into(options.socket));
    program.option("-s,--socket", "SOCKET", "SOCKET as an option (default: $HAPNET_SOCKET)",
                   cli::into(named));
    program.flag("--json", "Print the program's answer as it comes, for scripts", options.as_json);
    add_commands(program, options, settings);

    if (auto said = program.parse(words); !said || *said) return net::answer_of(std::move(said));
    for (const cli::Command& command : program.commands()) {
        if (command.is_chosen()) options.command = command.name();
    }
    if (!named.empty() && !options.socket.empty()) {
        return base::fail(fmt::format("two sockets, {} and --socket {}: give one of them",
                                      options.socket, named));
    }
    if (options.socket.empty()) options.socket = named;
    if (options.socket.empty() && default_socket != nullptr) options.socket = default_socket;
    if (options.socket.empty()) {
        return base::fail(fmt::format("which program? write hapnet-ctl SOCKET {}, or set "
                                      "HAPNET_SOCKET to the path of its --control",
                                      options.command));
    }
    if (const auto taken = take_settings(settings, options); !taken) {
        return base::fail("set: " + taken.error().message);
    }
    return options;
}

} // namespace hapnet::ctl

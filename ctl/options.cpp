// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "ctl/options.hpp"

#include "proto/base/text.hpp"
#include "proto/base/version.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <vector>

namespace hapnet::emulator {

namespace {

constexpr const char* description =
    "Asks a running hapnet-emulator or hapnet-peer how it is; changes an emulator, and stops a\n"
    "peer. SOCKET is what that program was given as --control. Every change takes effect between\n"
    "two datagrams; the answer says from which datagram of each direction on it holds.";

constexpr const char* footer =
    R"(Keys are those of a profile: up.delay holds from A to B, down.delay from B to A, both.delay
both ways. Units are mandatory: ns us ms s min for times, % for shares. A setting holds until the
profile's timeline says something about the same key; with --for it ends by itself, so that
nothing bad stays behind when nobody comes back.

A peer knows show, stats, watch, wait and stop. Nothing of it is changed while it runs.

Examples:
  hapnet-ctl /tmp/emulator.sock show
  hapnet-ctl /tmp/emulator.sock set both.delay 80ms both.loss 1%
  hapnet-ctl /tmp/emulator.sock set up.loss 100% --for 30s
  hapnet-ctl /tmp/emulator.sock show > now.toml
  hapnet-ctl /tmp/emulator.sock diff now.toml
  hapnet-ctl /tmp/emulator.sock apply now.toml
  hapnet-ctl /tmp/emulator.sock wait --until 'up.received>1000' --timeout 10s
  hapnet-ctl /tmp/emulator.sock stats
  hapnet-ctl /tmp/peer.sock wait --until 'messages.states_received>0'
  hapnet-ctl /tmp/peer.sock show
  hapnet-ctl /tmp/peer.sock stop

Exit codes: 0 done, 1 the condition was not met in time or the program went away, 2 bad usage or
refused by the program, 3 no program answers on the socket.)";

struct Texts {
    std::string socket;
    std::vector<std::string> settings;
    std::optional<std::string> lasting;
    std::string file;
    std::string until;
    std::optional<std::string> timeout;
    std::optional<std::string> every;
    bool as_json = false;
};

void add_commands(CLI::App& app, Texts& texts)
{
    const auto add = [&](const char* name, const char* help) {
        auto* command = app.add_subcommand(name, help)->fallthrough();
        command->set_help_flag("-h,--help", "Print this and exit");
        return command;
    };
    add("show", "Emulator: print the conditions that hold and the rest of the timeline, as a\n"
                "profile. Peer: print what it was told, and where it is in its life");
    auto* set = add("set", "Emulator: change settings: set KEY VALUE [KEY VALUE ...] [--for 30s]");
    set->add_option("settings", texts.settings, "Keys and values in turn")->type_name("KEY VALUE");
    set->add_option("--for", texts.lasting, "Only for so long; then holds what held without it")
        ->type_name("TIME");
    for (auto* command :
         {add("apply",
              "Emulator: replace the profile by that of a file; its timeline counts from now"),
          add("diff", "Emulator: print what apply would change")}) {
        command->add_option("file", texts.file, "A profile; - is stdin")
            ->type_name("FILE")
            ->required();
    }
    add("reset", "Emulator: go back to what it was started with");
    add("stats", "Print the statistics, as --stats of the program writes them");
    auto* watch = add("watch", "Print the main figures again and again, until Ctrl-C");
    watch->add_option("--every", texts.every, "The interval, at least 50ms (default 500ms)")
        ->type_name("TIME");
    add("stop", "Peer: end the session with zero force, as SIGTERM does; statistics are written");
    auto* wait = add("wait", "Wait until a condition holds: wait --until 'up.received>1000'");
    wait->add_option("--until", texts.until, "A key of stats, one of < <= == != >= >, and a number")
        ->type_name("CONDITION")
        ->required();
    wait->add_option("--timeout", texts.timeout, "Give up after so long, with exit code 1")
        ->type_name("TIME");
}

net::CommandLine<CtlOptions> options_from(const CLI::App& app, const Texts& texts)
{
    CtlOptions options{.socket = texts.socket,
                       .command = app.get_subcommands().front()->get_name(),
                       .settings = {},
                       .lasting = texts.lasting,
                       .file = texts.file,
                       .until = texts.until,
                       .timeout = texts.timeout,
                       .every = texts.every,
                       .as_json = texts.as_json};
    if (options.command == "set" && texts.settings.empty()) {
        return base::fail("set: what? Write set KEY VALUE, such as set both.delay 80ms");
    }
    if (texts.settings.size() % 2 != 0) {
        return base::fail(fmt::format("set: '{}' has no value: set KEY VALUE [KEY VALUE ...]",
                                      texts.settings.back()));
    }
    for (std::size_t i = 0; i < texts.settings.size(); i += 2) {
        options.settings.emplace_back(texts.settings[i], texts.settings[i + 1]);
    }
    for (const auto& [name, text] : {std::pair{"--for", options.lasting},
                                     {"--timeout", options.timeout},
                                     {"--every", options.every}}) {
        if (!text) continue;
        if (const auto time = base::parse_duration(*text); !time) {
            return base::fail(fmt::format("{}: {}", name, time.error().message));
        }
    }
    return options;
}

/// What is wrong with a line that CLI11 has refused: it does not tell a mistyped command.
std::string explained(std::span<char*> words, const CLI::App& app, const CLI::ParseError& error)
{
    std::vector<std::string> commands;
    for (const auto* command : app.get_subcommands(nullptr)) {
        commands.push_back(command->get_name());
    }
    const auto is_command = [&](const std::string& word) {
        return std::find(commands.begin(), commands.end(), word) != commands.end();
    };
    std::vector<std::string> plain; // without the options, of which none before the command has
    for (const char* word : words.subspan(1)) { // a value
        if (*word != '-') plain.emplace_back(word);
    }
    if (plain.empty() || is_command(plain[0])) {
        return fmt::format("first comes the socket: hapnet-ctl SOCKET {}",
                           plain.empty() ? "show" : plain[0]);
    }
    if (plain.size() < 2 || !is_command(plain[1])) {
        return fmt::format("{}; commands are {}",
                           plain.size() < 2 ? "no command is given"
                                            : "'" + plain[1] + "' is no command",
                           fmt::join(commands, ", "));
    }
    return error.what();
}

} // namespace

net::CommandLine<CtlOptions> parse_ctl_options(std::span<char*> words)
{
    CLI::App app{description, "hapnet-ctl"};
    app.footer(footer);
    app.set_help_flag("-h,--help", "Print this and exit");
    app.set_version_flag("--version", base::version_line("hapnet-ctl"),
                         "Print version, commit and compiler, and exit");
    app.require_subcommand(1);
    Texts texts;
    app.add_option("socket", texts.socket, "The program's --control")
        ->type_name("SOCKET")
        ->required();
    app.add_flag("--json", texts.as_json, "Print the answer as it is, for programs");
    add_commands(app, texts);
    try {
        app.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::CallForHelp&) {
        return net::Answer{app.help()};
    } catch (const CLI::CallForVersion&) {
        return net::Answer{app.version() + "\n"};
    } catch (const CLI::ParseError& error) {
        return base::fail(
            fmt::format("{} (--help lists the commands)", explained(words, app, error)));
    }
    return options_from(app, texts);
}

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/options.hpp"

#include "emulator/core/conditions.hpp"
#include "emulator/core/path_name.hpp"
#include "emulator/paths_options.hpp"
#include "emulator/profile_file.hpp"
#include "emulator/schemas.hpp"
#include "emulator/spacing.hpp"
#include "proto/base/text.hpp"
#include "proto/cli/command.hpp"
#include "proto/cli/parsers.hpp"
#include "proto/cli/synonyms.hpp"

#include <array>
#include <cctype>
#include <chrono>
#include <spdlog/fmt/fmt.h>
#include <tuple>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

constexpr const char* description =
    "A UDP relay between two hosts, A and B. It delays, drops, duplicates, corrupts, reorders and "
    "rate-limits datagrams; the same seed draws the same fates. What arrives at listen-a from A "
    "leaves from listen-b for B, and the other way round. No root is needed.\n"
    "\n"
    "Without --a and --b the emulator takes the first sender on each side, on loopback only. When "
    "that sender has been silent for 1 s, another one may take its place.\n"
    "\n"
    "With --listen and --upstream it stands between a server and any number of clients, with "
    "--link between many pairs at once.";

constexpr const char* footer =
    R"(Units are mandatory: ns us ms s min h for times, % for shares, B KiB for sizes, kbit/s Mbit/s
for rates; a bare 0 is zero. Each condition holds both ways. --up.delay 20ms or --down.loss 5% holds
one way only (up: A to B, down: B to A) and wins over the plain one. Each takes whatever a profile
takes, such as --loss '{ law = "gilbert", share = "2%", mean_burst = 5.0 }'. Conditions given here
win over those of --profile or --netem.

Datagrams pass mtu, rate, loss, corrupt, duplicate, delay, jitter, order and reorder, in this order.
With the same seed the same datagrams are lost in every run, whatever the other settings, unless the
law depends on time. No datagram leaves before it has arrived.

Examples:
  hapnet-emulator --listen-a :7001 --listen-b :7002 --delay 160ms
  hapnet-emulator --listen :7001 --upstream 10.0.0.5:53 --delay 80ms --loss 2%
  hapnet-emulator --listen-a 0.0.0.0:7001 --listen-b 0.0.0.0:7002 \
      --a 10.0.0.1:7000 --b 10.0.0.2:7000 --delay 80ms --jitter 5ms \
      --down.loss 10% --seed 42 --duration 30s --stats run.json
  hapnet-emulator --listen-a :7001 --listen-b :7002 --profile wifi-busy \
      --control emulator.sock --fates fates.csv --pcap run.pcapng
  hapnet-emulator --link 1-2=:7001,:7002 --link 1-3=:7003,:7004 \
      --delay 20ms --set 1-3.delay=80ms --set 3-1.loss=2%
  hapnet-emulator between --delay 40ms -- ping -c 5 b --- sleep infinity
  hapnet-emulator exec --delay 40ms --loss 1% -- curl https://example.org
  hapnet-emulator probe 127.0.0.1:7001 --count 10
  hapnet-emulator predict lte --rate 1000
  hapnet-emulator check --delay 80ms --jitter 15ms

The emulator prints one line "ready a=... b=..." (with --upstream "ready listen=...", with --link
"ready 1-2=...,...") on stdout when it listens; port 0 takes any free port. SIGINT or SIGTERM ends
the run and writes the files. SIGHUP reads --profile again; without a profile it ends the run.)";

constexpr const char* exit_codes = R"(  0  done
  1  the run failed, or did not meet a --require or a [[check]] of its profile
  2  bad usage or input
  3  the system refused (port in use, no permission))";

constexpr const char* check_description =
    "Prints a profile in canonical form, describes each stage, and warns of effects that are "
    "easily overlooked. The output is a profile again: the rest is comments.";

constexpr const char* check_footer =
    R"(Examples:
  hapnet-emulator check --list
  hapnet-emulator check lte > mine.toml
  hapnet-emulator check mesh.toml --link 1-2
  hapnet-emulator check --netem "delay 80ms 5ms loss 1%")";

constexpr const char* check_exit_codes = R"(  0  the profile can be used
  2  bad usage, or a profile with an error)";

constexpr const char* predict_description =
    "Sends a stream of datagrams through a profile in virtual time, by the same code that relays "
    "real ones, and prints the outcome beside what theory says.";

constexpr const char* predict_footer =
    R"(Examples:
  hapnet-emulator predict lte --rate 1000
  hapnet-emulator predict --jitter 15ms
  hapnet-emulator predict mesh.toml --link 1-2
  hapnet-emulator predict wifi-busy --packets 1000000 --json)";

constexpr const char* predict_exit_codes = R"(  0  done
  2  bad usage, or a profile with an error)";

/// Returns the description of a parameter of profiles as a sentence.
template <auto member>
std::string words(std::string_view more = "", std::string_view without = "0")
{
    std::string text{base::about<member>()};
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    return fmt::format("{}{} (default {})", text, more, without);
}

/// A condition, and its line in --help.
struct Condition {
    const char* name;
    const char* type;
    std::string help;
};

std::vector<Condition> listed_conditions()
{
    const auto burst = fmt::format("LOST: {}; OF: {} (default none)", base::about<&Burst::lost>(),
                                   base::about<&Burst::of>());
    const auto queue =
        fmt::format("; up to {} wait before it", base::size_text(Rate{}.queue_bytes_max));
    return {
        {"delay", "TIME", words<&ConstantLaw::value>()},
        {"jitter", "TIME", words<&UniformLaw::half_width>()},
        {"correlation-time", "TIME", "Time in which jitter forgets where it was (default 0ms)"},
        {"order", "ORDER",
         "Whether jitter may reorder. keep (default): never; wide jitter then lengthens the mean "
         "delay. free: each datagram leaves at its own time. sorted: at the times of free, but in "
         "order"},
        {"loss", "SHARE", words<&RandomLoss::share>()},
        {"burst-loss", "LOST/OF", burst},
        {"duplicate", "SHARE", words<&Duplication::share>()},
        {"corrupt", "SHARE", words<&Corruption::share>()},
        {"reorder", "TABLE",
         words<&Reordering::share>(": '{ share = \"1%\", displacement = 3 }'", "none")},
        {"rate", "RATE", words<&Rate::bits_per_second>(queue)},
        {"queue", "LAW",
         words<&QueueControl::law>(": drop-tail, codel, pie or fq-codel; needs a rate",
                                   "drop-tail")},
        {"mtu", "SIZE", words<&Mtu::bytes_max>()},
    };
}

constexpr const char* conditions_group = "Conditions, both ways (--up.NAME, --down.NAME: one way)";

/// Stores a condition as it is typed.
cli::Take as_setting(std::string key, ConditionOptions& into)
{
    return [key = std::move(key), &into](const std::string& text) -> base::Result<void> {
        into.settings.push_back({key, text});
        return {};
    };
}

/// Stores a setting that is given as a key and a value: "1-2.delay=80ms".
cli::Take by_key(ConditionOptions& into)
{
    return [&into](const std::string& text) -> base::Result<void> {
        const auto equals = text.find('=');
        if (equals == std::string::npos || equals == 0) {
            return base::fail(fmt::format("'{}': write KEY=VALUE, such as up.delay=80ms", text));
        }
        into.settings.push_back({text.substr(0, equals), text.substr(equals + 1), "--set "});
        return {};
    };
}

/// The differences among the commands that take conditions.
struct ConditionsFor {
    bool has_own_rate = false; // the command's own --rate also takes the condition
    /// Conditions of one of several paths, as examples; "": there is only one.
    std::string_view of_one_path = "1-2.delay=20ms, wan.up.loss=5% or client.3.delay=80ms";
};

void add_conditions(cli::Command& command, ConditionOptions& into, const ConditionsFor& what)
{
    command.option(
        "--netem", "SENTENCE",
        "Conditions as tc-netem takes them: \"delay 80ms 5ms loss 1%\"; names what netem "
        "would have done differently",
        cli::into(into.netem));
    command.option("--seed", "NUMBER", "Seed for every random draw (default: the profile's, or 1)",
                   cli::into(into.seed, cli::seed));
    command
        .option("--set", "KEY=VALUE",
                fmt::format("Sets a condition by its key: up.delay=20ms{}{}; may be repeated",
                            what.of_one_path.empty() ? ", down.queue=codel"
                                                     : ", and of one of several paths ",
                            what.of_one_path),
                by_key(into))
        .repeated();
    for (const char* prefix : {"", "up.", "down."}) {
        for (const auto& [name, type, help] : listed_conditions()) {
            const std::string key = fmt::format("{}{}", prefix, name);
            if (what.has_own_rate && key == "rate") continue;
            auto& option = command.option("--" + key, type, help, as_setting(key, into))
                               .under(conditions_group);
            if (*prefix != '\0') option.hidden();
        }
    }
}

base::Result<Timing> parse_timing(const std::string& text)
{
    return cli::meant_value("--timing", text).and_then(cli::named<Timing>);
}

base::Result<std::size_t> parse_in_flight(const std::string& text)
{
    constexpr std::size_t least = std::size_t{1} << 20;
    constexpr std::size_t most = std::size_t{64} << 30;
    const auto bytes = base::parse_size(text);
    if (!bytes) return tl::unexpected{bytes.error()};
    if (*bytes >= least && *bytes <= most) return static_cast<std::size_t>(*bytes);
    return base::fail(fmt::format("'{}' is out of range: 1MiB to 64GiB", text));
}

/// Appends conditions.
cli::Take require_into(std::vector<base::Condition>& into)
{
    return [&into](const std::string& text) -> base::Result<void> {
        auto condition = base::parse_condition(text);
        if (!condition) return tl::unexpected{condition.error()};
        into.push_back(*std::move(condition));
        return {};
    };
}

void add_relay_ends(cli::Command& program, Options& options)
{
    program.option("--listen-a", "ADDRESS",
                   "Where A sends to: HOST:PORT; :PORT listens on loopback. Required, as is "
                   "--listen-b, without --upstream and --link",
                   cli::into(options.listen_a, net::parse_listen_address));
    program.option("--listen-b", "ADDRESS", "Where B sends to",
                   cli::into(options.listen_b, net::parse_listen_address));
    program
        .option("--a", "HOST:PORT|HOST|NET/BITS",
                "Address of A; the first sender from one of several, HOST or NET/BITS, which may "
                "be repeated (default: the first sender)",
                allow_into(options.a))
        .repeated();
    program.option("--b", "HOST:PORT|HOST|NET/BITS", "The same of B", allow_into(options.b))
        .repeated();
}

/// Adds the options of every run, wherever its datagrams come from.
void add_run_options(cli::Command& program, Options& options, const ConditionsFor& conditions = {})
{
    program.option("--profile", "FILE|NAME",
                   "Conditions and their timeline from a TOML file, or the name of a preset "
                   "(hapnet-emulator check --list)",
                   cli::into(options.conditions.profile));
    add_conditions(program, options.conditions, conditions);
    program.option("--timing", "eco|precise|spin",
                   "eco: sleep until a datagram is due. precise (default): wake shortly before, by "
                   "as much as this machine needs, and watch the clock, as long as 70 % of a core "
                   "are enough. spin: wake 200 us before, without that limit; needs a core of its "
                   "own",
                   cli::into(options.timing, parse_timing));
    program.option("--budget", "TIME",
                   "The run is valid when 99 % of the datagrams in each direction leave at most "
                   "this late (default 1ms)",
                   cli::into(options.budget, base::Time{}));
    program.option("--in-flight", "SIZE",
                   "Memory for the datagrams in flight, of both directions together (default "
                   "256MiB). Each direction holds one datagram for each KiB of it, but at least "
                   "65 536; one that finds no room is dropped as queue_full",
                   cli::into(options.in_flight_bytes, parse_in_flight));
    program.option("--duration", "TIME", "End after this time (default: run until stopped)",
                   cli::into(options.duration, base::Time{std::chrono::milliseconds{1}}));
    program.option("--stats", "FILE", "Write statistics to FILE at the end; - is stdout",
                   cli::into(options.stats));
    program.option("--fates", "FILE", "Write the fate of each datagram to FILE (CSV)",
                   cli::into(options.fates));
    program.option("--replay", "FILE",
                   "Apply the fates that --fates wrote to FILE instead of drawing them: the n-th "
                   "datagram gets the n-th fate",
                   cli::into(options.replay));
    program
        .option("--require", "CONDITION",
                "What the statistics must meet in the end, such as 'up.received>=1000', or the "
                "run has failed (exit code 1); may be repeated",
                require_into(options.required))
        .repeated();
    program.option("--control", "SOCKET",
                   "Listen on this Unix socket for hapnet-ctl, which shows and changes the "
                   "conditions while the emulator runs",
                   cli::into(options.control));
    program.option("--files", "DIR",
                   "Clients of the control socket may name files below DIR (default: none)",
                   cli::into(options.files));
}

void add_capture(cli::Command& program, Options& options)
{
    program.option("--pcap", "FILE",
                   "Capture both sides to FILE, with a comment on each packet (pcapng, for "
                   "Wireshark)",
                   cli::into(options.capture));
    cli::add_keep(program, options.keep, "what --pcap would write");
}

/// Takes a number of datagrams a second, or a bit rate for the condition of this name.
cli::Take stream_rate(tools::Stream& stream, ConditionOptions& into)
{
    return [&stream, &into](const std::string& text) -> base::Result<void> {
        if (text.find("bit") != std::string::npos || text.find("bps") != std::string::npos) {
            into.settings.push_back({"rate", text});
            return {};
        }
        const auto spacing = parse_spacing(text, "datagrams", 7);
        if (!spacing) return tl::unexpected{spacing.error()};
        stream.spacing = *spacing;
        return {};
    };
}

/// Adds the options of check and of predict.
void add_dry_run(cli::Command& command, ConditionOptions& conditions_from, tools::Stream& stream)
{
    constexpr std::uint64_t bytes_max = 65'507; // largest UDP payload over IPv4
    conditions_from.profile_option = "";
    command.positional("PROFILE", "A profile: a file, or the name of a preset",
                       cli::into(conditions_from.profile));
    command.option("--profile", "FILE|NAME", "", cli::into(conditions_from.profile)).hidden();
    command
        .option("--rate", "RATE",
                "Datagrams a second, each way (default 1000). With a unit, as in 10Mbit/s, a limit "
                "of the bit rate (as the emulator's --rate)",
                stream_rate(stream, conditions_from))
        .repeated();
    command.option("--bytes", "NUMBER",
                   "Payload of each datagram (default 136: a state of a hand and a cube)",
                   cli::into(stream.bytes, base::Count{0, bytes_max}));
    command.option("--link", "NAME",
                   "Which path of a profile with several, with what holds on all of them: 1-2, "
                   "wan or client.3",
                   into_path(stream.path));
    command.option("--flow", "NAME", "Which flow of a profile with flows (default: the rest)",
                   into_flow(stream.path));
    add_conditions(command, conditions_from, {.has_own_rate = true});
}

cli::Command& add_check(cli::Command& program, CheckOptions& options, bool& is_list)
{
    cli::Command& command = program.command("check", "Describes a profile, stage by stage");
    command.describe(check_description);
    command.add_footer(check_footer);
    command.add_exit_codes(check_exit_codes);
    add_dry_run(command, options.conditions, options.stream);
    command.flag("--list", "Print the names of the presets and exit", is_list);
    return command;
}

cli::Command& add_predict(cli::Command& program, PredictOptions& options, bool& is_list)
{
    constexpr std::uint64_t packets_max = 1'000'000'000;
    cli::Command& command =
        program.command("predict", "Predicts the effect of a profile on a stream of datagrams");
    command.describe(predict_description);
    command.add_footer(predict_footer);
    command.add_exit_codes(predict_exit_codes);
    add_dry_run(command, options.conditions, options.stream);
    command.option(
        "--packets", "NUMBER",
        "Number of datagrams, each way (default: 400000, and on up to 6400000 until mean and "
        "deviation of the delay are known to 1 %)",
        cli::into(options.stream.packets, base::Count{1, packets_max}));
    command.flag("--sealed",
                 "The stream of peers with keys: 16 bytes longer, and a damaged datagram is lost",
                 options.stream.is_sealed);
    command.flag("--json", "Print one JSON object instead of text", options.as_json);
    command.flag("--list", "Print the names of the presets and exit", is_list);
    return command;
}

base::Result<void> require_conditions(const ConditionOptions& options, const cli::Command& command)
{
    if (options.profile || options.netem || !options.settings.empty()) return {};
    return base::fail(fmt::format("conditions are required: {0} PROFILE, {0} --netem \"delay "
                                  "80ms\" or {0} --delay 80ms; PROFILE is a file, or one of {1}",
                                  command.path(), preset_list(' ')));
}

/// Refuses two results in one file: the second would replace the first, after the run. Devices such
/// as /dev/null accept several.
base::Result<void> require_own_files(const Options& options)
{
    using Named = std::pair<const char*, const std::optional<std::string>&>;
    const std::array<Named, 4> files{
        Named{"--stats", options.stats}, Named{"--fates", options.fates},
        Named{"--pcap", options.capture}, Named{"--control", options.control}};
    for (std::size_t i = 0; i < files.size(); ++i) {
        const auto& [option, file] = files[i];
        if (!file || *file == "-" || file->starts_with("/dev/")) continue;
        for (std::size_t j = i + 1; j < files.size(); ++j) {
            if (files[j].second != file) continue;
            return base::fail(fmt::format("{} and {} name the same file, {}: give each its own",
                                          option, files[j].first, *file));
        }
    }
    if (options.files && !options.control) return base::fail("--files needs --control SOCKET");
    return cli::check_keep(options.keep, options.control.has_value());
}

base::Result<void> require_own_addresses(const Options& options)
{
    const auto& [a, b] = std::tie(options.listen_a, options.listen_b);
    if (a.port == 0 || a.port != b.port || a.host != b.host) return {};
    return base::fail(fmt::format("--listen-a and --listen-b are the same address, {}:{}: give "
                                  "each side its own port",
                                  a.host, a.port));
}

base::Result<void> require_addresses(const cli::Command& program)
{
    const std::array required{std::pair{"--listen-a", "127.0.0.1:7001"},
                              std::pair{"--listen-b", "127.0.0.1:7002"}};
    const bool has_pair = program.is_given("--listen-a") || program.is_given("--listen-b");
    if (program.is_given("--listen") && !has_pair) {
        return base::fail("--upstream is required with --listen: --upstream 127.0.0.1:9000, the "
                          "server that its clients are sent on to");
    }
    for (const auto& [option, example] : required) {
        if (program.is_given(option)) continue;
        return base::fail(
            fmt::format("{0} is required: {0} {1}, or --listen and --upstream for any "
                        "client of a server, or --link for many pairs",
                        option, example));
    }
    for (const char* option : {"--listen", "--allow", "--clients", "--idle", "--name-by"}) {
        if (!program.is_given(option)) continue;
        return base::fail(fmt::format("{} goes with --upstream HOST:PORT", option));
    }
    if (program.is_given("--threads")) {
        return base::fail("--threads goes with --link or --upstream: a pair is never divided");
    }
    return {};
}

net::CommandLine<AnyOptions> checked(Options options, const cli::Command& program)
{
    auto fine = require_addresses(program);
    if (fine) fine = require_own_addresses(options);
    if (fine) fine = require_own_files(options);
    if (!fine) return tl::unexpected{fine.error()};
    return AnyOptions{std::move(options)};
}

/// Returns the run that the options describe.
net::CommandLine<AnyOptions> chosen_run(Options options, LinkOptions links, UpstreamOptions through,
                                        const cli::Command& program)
{
    const bool has_links = program.is_given("--link");
    if (!has_links && !program.is_given("--upstream")) return checked(std::move(options), program);
    auto fine = has_links ? require_links(links, program) : require_upstream(program);
    if (fine) fine = require_own_files(options);
    if (!fine) return tl::unexpected{fine.error()};
    (has_links ? links.run : through.run) = std::move(options);
    if (has_links) return AnyOptions{std::move(links)};
    return AnyOptions{std::move(through)};
}

net::CommandLine<AnyOptions> checked(BetweenOptions options, TypedCommands commands)
{
    auto fine = require_several_commands(commands);
    if (fine) fine = require_own_files(options.run);
    if (!fine) return tl::unexpected{fine.error()};
    options.commands = std::move(commands);
    return AnyOptions{std::move(options)};
}

net::CommandLine<AnyOptions> checked(ExecOptions options, TypedCommands commands)
{
    auto fine = require_one_command(commands);
    if (fine) fine = require_own_files(options.run);
    if (!fine) return tl::unexpected{fine.error()};
    options.command = std::move(commands.front());
    return AnyOptions{std::move(options)};
}

net::CommandLine<AnyOptions> checked(BridgeOptions options)
{
    auto fine = require_two_interfaces(options.a, options.b);
    if (fine) fine = require_own_files(options.run);
    if (!fine) return tl::unexpected{fine.error()};
    return AnyOptions{std::move(options)};
}

/// Adds the options that the commands for frames have in common. `of_one_path`: see ConditionsFor.
void add_frames(cli::Command& command, auto& options, std::string_view of_one_path = "")
{
    add_run_options(command, options.run, {.of_one_path = of_one_path});
    add_capture(command, options.run);
    add_frame_options(command, options.frames);
}

/// The commands for frames, and the objects that store their options.
class FrameCommands {
public:
    explicit FrameCommands(cli::Command& program)
        : between_command_{add_between(program)},
          exec_command_{add_exec(program, exec_.through)},
          bridge_command_{add_bridge(program, bridge_.a, bridge_.b, bridge_.frames)}
    {
        add_frames(between_command_, between_, "a-c.delay=80ms or a-c.up.loss=2%");
        add_frames(exec_command_, exec_);
        add_frames(bridge_command_, bridge_);
    }
    FrameCommands(const FrameCommands&) = delete; // the commands know where the options are
    FrameCommands& operator=(const FrameCommands&) = delete;
    ~FrameCommands() = default;

    /// Returns the command that was asked for; nullopt: none of them. Call it once: it moves the
    /// options out.
    std::optional<net::CommandLine<AnyOptions>> chosen(TypedCommands typed)
    {
        if (between_command_.is_chosen()) return checked(std::move(between_), std::move(typed));
        if (exec_command_.is_chosen()) return checked(std::move(exec_), std::move(typed));
        if (bridge_command_.is_chosen()) return checked(std::move(bridge_));
        return std::nullopt;
    }

private:
    BetweenOptions between_{};
    ExecOptions exec_{};
    BridgeOptions bridge_{};
    cli::Command& between_command_;
    cli::Command& exec_command_;
    cli::Command& bridge_command_;
};

} // namespace

net::CommandLine<AnyOptions> parse_command_line(std::span<char*> all_words)
{
    TypedCommands typed;
    const auto words = take_commands(all_words, typed);
    cli::Command program{"hapnet-emulator"};
    program.describe(description);
    program.add_footer(footer);
    program.add_exit_codes(exit_codes);
    Options options;
    add_relay_ends(program, options);
    add_run_options(program, options);
    add_capture(program, options);
    UpstreamOptions through;
    add_upstream_options(program, through);
    LinkOptions links;
    add_link_options(program, links);
    add_threads(program, options.threads);

    CheckOptions checking;
    bool is_list = false;
    const cli::Command& check = add_check(program, checking, is_list);
    PredictOptions predicting;
    const cli::Command& predict = add_predict(program, predicting, is_list);
    VerifyOptions verifying;
    const cli::Command& verify = add_verify(program, verifying);
    ReportOptions reporting;
    const cli::Command& report = add_report(program, reporting);
    LearnOptions learning;
    const cli::Command& learn = add_learn(program, learning);
    ProbeOptions probing;
    const cli::Command& probe = add_probe(program, probing);
    FrameCommands frames{program};
    const cli::SchemaCommand schema{program, schemas()};

    if (auto said = program.parse(words); !said || *said) return net::answer_of(std::move(said));
    if (schema.is_chosen()) return net::Answer{schema.text()};
    if (learn.is_chosen()) return AnyOptions{std::move(learning)};
    if (report.is_chosen()) return AnyOptions{std::move(reporting)};
    if (is_list) return net::Answer{preset_list('\n')};
    if (verify.is_chosen()) return AnyOptions{std::move(verifying)};
    if (probe.is_chosen()) {
        if (auto fine = require_probe(probing, probe); !fine) return tl::unexpected{fine.error()};
        return AnyOptions{std::move(probing)};
    }
    if (auto chosen = frames.chosen(std::move(typed))) return *std::move(chosen);
    if (!check.is_chosen() && !predict.is_chosen()) {
        return chosen_run(std::move(options), std::move(links), std::move(through), program);
    }
    if (predict.is_given("--packets")) predicting.packets_max.reset();
    const auto fine = check.is_chosen() ? require_conditions(checking.conditions, check)
                                        : require_conditions(predicting.conditions, predict);
    if (!fine) return tl::unexpected{fine.error()};
    return check.is_chosen() ? AnyOptions{std::move(checking)} : AnyOptions{std::move(predicting)};
}

} // namespace hapnet::emulator

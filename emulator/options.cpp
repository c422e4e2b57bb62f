// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/options.hpp"

#include "proto/base/text.hpp"
#include "proto/base/version.hpp"

#include <CLI/CLI.hpp>
#include <array>
#include <limits>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

constexpr const char* description =
    "A UDP relay that stands between two hosts, A and B, and impairs what passes: delay, jitter,\n"
    "loss, copies, bit errors, reordering, a rate, outages; by a seed, and never early.\n"
    "What arrives at listen-a from A leaves from listen-b for B, and the other way round.\n"
    "Needs no root. Without --a and --b it takes the first sender on each side, on loopback only;\n"
    "when that one has been silent for 1 s, a new one may take its place.";

constexpr const char* footer =
    R"(Units are mandatory: ns us ms s min for times, % for shares, B KiB for sizes, kbit/s Mbit/s
for rates; a bare 0 is zero. Each condition holds both ways; --up.delay 20ms or --down.loss 5% holds
one way only (up: A to B, down: B to A) and wins over the plain one, and each takes whatever a
profile takes: --loss '{ law = "gilbert", share = "2%", mean_burst = 5.0 }'.
Conditions given here win over those of --profile or --netem.
Datagrams pass mtu, rate, loss, corrupt, duplicate, delay, jitter, order, reorder, in this order.
The same seed loses the same n-th datagrams of a direction in every run, whatever the rest is.

Examples:
  hapnet-emulator --listen-a 127.0.0.1:7001 --listen-b 127.0.0.1:7002 --delay 160ms
  hapnet-emulator --listen-a 0.0.0.0:7001 --listen-b 0.0.0.0:7002 \
      --a 10.0.0.1:7000 --b 10.0.0.2:7000 --delay 80ms --jitter 5ms --down.loss 10% \
      --seed 42 --duration 30s --stats run.json
  hapnet-emulator --listen-a 127.0.0.1:7001 --listen-b 127.0.0.1:7002 --profile wifi-busy \
      --control emulator.sock --fates fates.csv --pcap run.pcapng

Without a network (each has a --help of its own):
  hapnet-emulator check PROFILE                   what a profile says, stage by stage
  hapnet-emulator predict PROFILE --rate 1000     what it will do to so many datagrams a second
  hapnet-emulator verify RUN                      whether a run's fates follow their laws

Prints one line "ready a=... b=..." on stdout when it listens; port 0 takes any free port.
SIGINT or SIGTERM ends it and writes the files; SIGHUP reads --profile again (and ends
a run without one).
Exit codes: 0 done, 1 the run failed, 2 bad usage or input, 3 the system refused (port in use).)";

/// What follows an option, if it was given.
using Text = std::optional<std::string>;

/// A condition, and what --help says of it.
struct Condition {
    const char* name;
    const char* type;
    const char* help;
};
constexpr std::array condition_options{
    Condition{"delay", "TIME", "Delay of every datagram (default 0)"},
    Condition{"jitter", "TIME",
              "Half width of a uniform offset, drawn for each datagram: 5ms is -5ms to +5ms\n"
              "(default 0). Nothing leaves before it has arrived."},
    Condition{"order", "keep|free|sorted",
              "Whether jitter may reorder. keep (default): never; wide jitter then lengthens the\n"
              "mean delay. free: each datagram leaves at its own time. sorted: at the times of\n"
              "free, but in order."},
    Condition{"loss", "SHARE", "Loss of each datagram on its own (default 0)"},
    Condition{"burst-loss", "LOST/OF", "40/100: lose 40 in a row of every 100 (default 0)"},
    Condition{"duplicate", "SHARE", "Send a second copy of so many (default 0)"},
    Condition{"corrupt", "SHARE", "Invert a bit of so many (default 0)"},
    Condition{"reorder", "TABLE",
              "Send some behind their turn: '{ share = \"1%\", displacement = 3 }'"},
    Condition{"rate", "RATE", "Bits per second, with a drop-tail queue of 64KiB (default: any)"},
    Condition{"mtu", "SIZE", "Drop what is larger with its IP and UDP headers (default: none)"},
};

constexpr std::array<const char*, 3> prefixes{"", "up.", "down."};

struct Texts {
    Text listen_a;
    Text listen_b;
    Text a;
    Text b;
    Text profile;
    Text netem;
    std::array<std::array<Text, condition_options.size()>, prefixes.size()> by_way;
    Text seed;
    Text replay;
    Text timing;
    Text budget;
    Text duration;
    Text stats;
    Text fates;
    Text capture;
    Text control;
};

void add_conditions(CLI::App& app, Texts& texts)
{
    for (std::size_t way = 0; way < prefixes.size(); ++way) {
        for (std::size_t i = 0; i < condition_options.size(); ++i) {
            const auto& [name, type, help] = condition_options[i];
            app.add_option(fmt::format("--{}{}", prefixes[way], name), texts.by_way[way][i], help)
                ->type_name(type)
                ->group(way == 0 ? "Conditions, both ways (--up.NAME, --down.NAME: one way)" : "");
        }
    }
}

void add_run_options(CLI::App& app, Texts& texts)
{
    app.add_option("--seed", texts.seed, "Of all chance in the run (default: the profile's, or 1)")
        ->type_name("NUMBER");
    app.add_option("--timing", texts.timing,
                   "eco: sleep until a datagram is due. precise (default): wake shortly before,\n"
                   "by as much as this machine needs, and watch the clock. spin: wake 200 us\n"
                   "before.")
        ->type_name("eco|precise|spin");
    app.add_option("--budget", texts.budget,
                   "The run is called valid when 99 % of the datagrams leave at most this late\n"
                   "(default 1ms)")
        ->type_name("TIME");
    app.add_option("--duration", texts.duration, "End after this time (default: run until stopped)")
        ->type_name("TIME");
    app.add_option("--stats", texts.stats, "Write statistics to FILE at the end; - is stdout")
        ->type_name("FILE");
    app.add_option("--fates", texts.fates, "Write what became of each datagram to FILE (CSV)")
        ->type_name("FILE");
    app.add_option("--replay", texts.replay,
                   "Give the n-th datagram the n-th fate of FILE, which --fates wrote, instead of\n"
                   "drawing it")
        ->type_name("FILE");
    app.add_option("--pcap", texts.capture,
                   "Capture both sides to FILE, a comment on each packet (pcapng, for Wireshark)")
        ->type_name("FILE");
    app.add_option("--control", texts.control,
                   "Listen on this Unix socket for hapnet-ctl, which shows and changes the\n"
                   "conditions while it runs")
        ->type_name("SOCKET");
}

void add_options(CLI::App& app, Texts& texts)
{
    app.add_option("--listen-a", texts.listen_a, "Where A sends to (required)")
        ->type_name("HOST:PORT");
    app.add_option("--listen-b", texts.listen_b, "Where B sends to (required)")
        ->type_name("HOST:PORT");
    app.add_option("--a", texts.a, "A itself (default: the first sender)")->type_name("HOST:PORT");
    app.add_option("--b", texts.b, "B itself (default: the first sender)")->type_name("HOST:PORT");
    app.add_option("--profile", texts.profile,
                   "Conditions and their timeline from a TOML file, or the name of a preset\n"
                   "(hapnet-emulator check --list)")
        ->type_name("FILE|NAME");
    app.add_option(
           "--netem", texts.netem,
           "Conditions as tc-netem takes them: \"delay 80ms 5ms loss 1%\"; says where netem\n"
           "would not have done what this says")
        ->type_name("SENTENCE");
    add_conditions(app, texts);
    add_run_options(app, texts);
}

/// Puts parsed texts in their places; the first error wins and names its option.
class Reader {
public:
    template <typename Target, typename Parse>
    void read(const std::string& option, const Text& text, Target& target, Parse parse)
    {
        if (!text || error_) return;
        auto value = parse(*text);
        if (value) {
            target = *std::move(value);
        } else {
            error_ = fmt::format("{}: {}", option, value.error().message);
        }
    }

    /// Not left to CLI11, which would speak of it before it speaks of a mistyped option.
    void require(const std::string& option, const Text& text, const char* example)
    {
        if (!text && !error_) error_ = fmt::format("{0} is required: {0} {1}", option, example);
    }

    [[nodiscard]] const std::optional<std::string>& error() const { return error_; }

private:
    std::optional<std::string> error_;
};

base::Result<Timing> parse_timing(const std::string& text)
{
    for (const Timing timing : {Timing::eco, Timing::precise, Timing::spin}) {
        if (text == to_text(timing)) return timing;
    }
    return base::fail(fmt::format("'{}' is not a timing: write eco, precise or spin", text));
}

base::Result<base::Seed> parse_seed(const std::string& text)
{
    return base::parse_count(text, std::numeric_limits<std::uint64_t>::max())
        .map([](std::uint64_t value) { return base::Seed{value}; });
}

base::Result<net::HostPort> parse_peer(const std::string& text)
{
    auto peer = net::parse_host_port(text);
    if (peer && peer->port == 0) {
        return base::fail(fmt::format("'{}': nobody can be reached at port 0", text));
    }
    return peer;
}

/// Two results in one file: the second would take the place of the first, after the run. Devices
/// such as /dev/null take many.
std::optional<std::string> shared_file(const Texts& texts)
{
    using Named = std::pair<const char*, const Text&>;
    const std::array<Named, 4> files{Named{"--stats", texts.stats}, Named{"--fates", texts.fates},
                                     Named{"--pcap", texts.capture},
                                     Named{"--control", texts.control}};
    for (std::size_t i = 0; i < files.size(); ++i) {
        const auto& [option, file] = files[i];
        if (!file || *file == "-" || file->starts_with("/dev/")) continue;
        for (std::size_t j = i + 1; j < files.size(); ++j) {
            if (files[j].second != file) continue;
            return fmt::format("{} and {} name the same file, {}: give each its own", option,
                               files[j].first, *file);
        }
    }
    return std::nullopt;
}

net::CommandLine<Options> options_from(const Texts& texts)
{
    Options options;
    Reader reader;
    reader.require("--listen-a", texts.listen_a, "127.0.0.1:7001");
    reader.require("--listen-b", texts.listen_b, "127.0.0.1:7002");
    reader.read("--listen-a", texts.listen_a, options.listen_a, net::parse_host_port);
    reader.read("--listen-b", texts.listen_b, options.listen_b, net::parse_host_port);
    reader.read("--a", texts.a, options.a, parse_peer);
    reader.read("--b", texts.b, options.b, parse_peer);
    for (std::size_t way = 0; way < prefixes.size(); ++way) {
        for (std::size_t i = 0; i < condition_options.size(); ++i) {
            if (const Text& value = texts.by_way[way][i]) {
                options.settings.push_back(
                    {prefixes[way] + std::string{condition_options[i].name}, *value});
            }
        }
    }
    reader.read("--seed", texts.seed, options.seed, parse_seed);
    reader.read("--timing", texts.timing, options.timing, parse_timing);
    reader.read("--budget", texts.budget, options.budget, base::parse_duration);
    reader.read("--duration", texts.duration, options.duration, base::parse_duration);
    options.profile = texts.profile;
    options.netem = texts.netem;
    options.replay = texts.replay;
    options.stats = texts.stats;
    options.fates = texts.fates;
    options.capture = texts.capture;
    options.control = texts.control;
    if (reader.error()) return base::fail(*reader.error());
    if (const auto trouble = shared_file(texts)) return base::fail(*trouble);
    return options;
}

} // namespace

std::string_view to_text(Timing timing)
{
    switch (timing) {
    case Timing::eco: return "eco";
    case Timing::precise: return "precise";
    case Timing::spin: return "spin";
    }
    return {};
}

net::CommandLine<Options> parse_options(std::span<char*> words)
{
    CLI::App app{description, "hapnet-emulator"};
    app.footer(footer);
    app.set_help_flag("-h,--help", "Print this and exit");
    app.set_version_flag("--version", base::version_line("hapnet-emulator"),
                         "Print version, commit and compiler, and exit");
    Texts texts;
    add_options(app, texts);
    try {
        app.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::CallForHelp&) {
        return net::Answer{app.help()};
    } catch (const CLI::CallForVersion&) {
        return net::Answer{app.version() + "\n"};
    } catch (const CLI::ParseError& error) {
        return base::fail(fmt::format("{} (--help lists the options)", error.what()));
    }
    return options_from(texts);
}

} // namespace hapnet::emulator

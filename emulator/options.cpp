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
    "A UDP relay that stands between two hosts, A and B, and delays, jitters and loses what\n"
    "passes. What arrives at listen-a from A leaves from listen-b for B, and the other way round.\n"
    "Needs no root. Without --a and --b it takes the first sender on each side, on loopback only;\n"
    "when that one has been silent for 1 s, a new one may take its place.";

constexpr const char* footer =
    R"(Units are mandatory: ns us ms s min for times, % for shares; a bare 0 is zero.
--delay, --jitter, --order, --loss and --burst-loss hold both ways; --up.delay 20ms or
--down.loss 5% hold for one way only (up: A to B, down: B to A) and win over the plain ones.
Datagrams pass random loss, burst loss, delay, jitter, in this order. The same seed loses the
same n-th datagrams of a direction in every run, whatever delay and jitter are.

Examples:
  hapnet-emulator --listen-a 127.0.0.1:7001 --listen-b 127.0.0.1:7002 --delay 160ms
  hapnet-emulator --listen-a 0.0.0.0:7001 --listen-b 0.0.0.0:7002 \
      --a 10.0.0.1:7000 --b 10.0.0.2:7000 --delay 80ms --jitter 5ms --down.loss 10% \
      --seed 42 --duration 30s --stats run.json

Prints one line "ready a=... b=..." on stdout when it listens; port 0 takes any free port.
SIGINT or SIGTERM ends it and writes the statistics.
Exit codes: 0 done, 1 the run failed, 2 bad usage, 3 the system refused (port in use, no route).)";

/// What follows an option, if it was given.
using Text = std::optional<std::string>;

/// The texts of the options that exist for both ways and for each way.
struct ConditionTexts {
    Text delay;
    Text jitter;
    Text order;
    Text loss;
    Text burst_loss;
};

struct Texts {
    Text listen_a;
    Text listen_b;
    Text a;
    Text b;
    std::array<ConditionTexts, 3> conditions; // of both, up, down
    Text seed;
    Text timing;
    Text budget;
    Text duration;
    Text stats;
    Text control;
};

constexpr std::array<const char*, 3> prefixes{"", "up.", "down."};

void add_conditions(CLI::App& app, const std::string& prefix, ConditionTexts& texts)
{
    const std::string group = prefix.empty()    ? "Both ways"
                              : prefix == "up." ? "Up: from A to B"
                                                : "Down: from B to A";
    const auto add = [&](const char* name, Text& text, const char* help) {
        return app.add_option("--" + prefix + name, text, prefix.empty() ? help : "")->group(group);
    };
    add("delay", texts.delay, "Delay of every datagram (default 0)")->type_name("TIME");
    add("jitter", texts.jitter,
        "Half width of a uniform offset, drawn for each datagram: 5ms is -5ms to +5ms\n"
        "(default 0). Nothing leaves before it has arrived.")
        ->type_name("TIME");
    add("order", texts.order,
        "Whether jitter may reorder. keep (default): never; wide jitter then lengthens the\n"
        "mean delay. free: each datagram leaves at its own time.")
        ->type_name("keep|free");
    add("loss", texts.loss, "Loss of each datagram on its own (default 0)")->type_name("SHARE");
    add("burst-loss", texts.burst_loss, "40/100: lose 40 in a row of every 100 (default 0)")
        ->type_name("LOST/OF");
}

void add_options(CLI::App& app, Texts& texts)
{
    app.add_option("--listen-a", texts.listen_a, "Where A sends to (required)")
        ->type_name("HOST:PORT");
    app.add_option("--listen-b", texts.listen_b, "Where B sends to (required)")
        ->type_name("HOST:PORT");
    app.add_option("--a", texts.a, "A itself (default: the first sender)")->type_name("HOST:PORT");
    app.add_option("--b", texts.b, "B itself (default: the first sender)")->type_name("HOST:PORT");
    for (std::size_t i = 0; i < prefixes.size(); ++i) {
        add_conditions(app, prefixes[i], texts.conditions[i]);
    }
    app.add_option("--seed", texts.seed, "Of all chance in the run (default 1)")
        ->type_name("NUMBER");
    app.add_option("--timing", texts.timing,
                   "eco: sleep until a datagram is due. precise (default): wake 60 us before and\n"
                   "watch the clock. spin: wake 200 us before.")
        ->type_name("eco|precise|spin");
    app.add_option("--budget", texts.budget,
                   "The run is called valid when 99 % of the datagrams leave at most this late\n"
                   "(default 1ms)")
        ->type_name("TIME");
    app.add_option("--duration", texts.duration, "End after this time (default: run until stopped)")
        ->type_name("TIME");
    app.add_option("--stats", texts.stats, "Write statistics to FILE at the end; - is stdout")
        ->type_name("FILE");
    app.add_option("--control", texts.control,
                   "Listen for hapnet-ctl on a Unix socket at this path; only its owner may use it")
        ->type_name("SOCKET");
}

base::Result<Order> parse_order(std::string_view text)
{
    for (const Order order : {Order::keep, Order::free, Order::sorted}) {
        if (text == to_text(order)) return order;
    }
    return base::fail(fmt::format("'{}' is not an order: write keep, free or sorted", text));
}

base::Result<LossLaw> parse_burst(std::string_view text)
{
    constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
    const auto slash = text.find('/');
    if (slash != std::string_view::npos) {
        const auto lost = base::parse_count(text.substr(0, slash), most);
        const auto of = base::parse_count(text.substr(slash + 1), most);
        if (lost && of && 0 < *lost && *lost <= *of) {
            return LossLaw{
                Burst{static_cast<std::uint32_t>(*lost), static_cast<std::uint32_t>(*of), {}}};
        }
    }
    return base::fail(fmt::format("'{}' is not a burst: write LOST/OF, such as 40/100 for 40 in a "
                                  "row of every 100",
                                  text));
}

base::Result<Variation> parse_constant(const std::string& text)
{
    return base::parse_duration(text).map([](base::Duration value) { return constant(value); });
}

base::Result<Variation> parse_uniform(const std::string& text)
{
    return base::parse_duration(text).map([](base::Duration value) { return uniform(value); });
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

    void read_conditions(const std::string& prefix, const ConditionTexts& texts, Conditions& target)
    {
        const std::string dashes = "--" + prefix;
        const auto random = [](const std::string& text) {
            return base::parse_probability(text).map(
                [](base::Probability share) { return LossLaw{RandomLoss{share}}; });
        };
        read(dashes + "delay", texts.delay, target.delay, parse_constant);
        read(dashes + "jitter", texts.jitter, target.jitter, parse_uniform);
        read(dashes + "order", texts.order, target.order, parse_order);
        std::optional<LossLaw> loss;
        std::optional<LossLaw> burst;
        read(dashes + "loss", texts.loss, loss, random);
        read(dashes + "burst-loss", texts.burst_loss, burst, parse_burst);
        if (loss) target.loss.push_back(*loss);
        if (burst) target.loss.push_back(*burst);
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
    for (Conditions* conditions : {&options.path.up, &options.path.down}) {
        reader.read_conditions(prefixes[0], texts.conditions[0], *conditions);
    }
    reader.read_conditions(prefixes[1], texts.conditions[1], options.path.up);
    reader.read_conditions(prefixes[2], texts.conditions[2], options.path.down);
    reader.read("--seed", texts.seed, options.seed, parse_seed);
    reader.read("--timing", texts.timing, options.timing, parse_timing);
    reader.read("--budget", texts.budget, options.budget, base::parse_duration);
    reader.read("--duration", texts.duration, options.duration, base::parse_duration);
    options.stats = texts.stats;
    options.control = texts.control;
    if (reader.error()) return base::fail(*reader.error());
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

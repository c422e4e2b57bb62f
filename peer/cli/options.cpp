// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/options.hpp"

#include "peer/core/shared_body.hpp"
#include "peer/core/sync/text.hpp"
#include "proto/base/quantity.hpp"
#include "proto/base/text.hpp"
#include "proto/base/version.hpp"
#include "proto/net/text_file.hpp"
#include "scene/text/text.hpp"

#include <CLI/CLI.hpp>
#include <limits>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer {

namespace {

constexpr const char* description =
    "One of two peers that push the same virtual cube and feel each other through it: a 1 kHz\n"
    "haptic loop with its own copy of the scene, a device, and 1000 messages a second to the\n"
    "other peer, directly or through hapnet-emulator.";

constexpr const char* footer =
    R"(Tasks of the hands (docs/design/tasks.md; the lower --id is L and pushes from the left):
  P1  L holds the cube and carries it along a prescribed path, R watches (the paper's Table 1)
  T1  by turns: L pushes the cube where the path rises, R where it falls
  T2  one holds, the other presses against it at 0.5, 1 and 2 Hz; then the other way round
  T3  both squeeze the cube between them and carry it along the path at half speed
  T4  both squeeze the cube, lift it by 50 mm, hold it for 5 s and put it down
  T5  both press the cube against the static one; by turns one lets go suddenly
  T6  L taps the cube at 3 Hz while R rests on its far side
Each ends with 3 s hands off, within --duration (half of it when that is below 6s). Both peers
need the same task, and should be given the same --duration. A peer waits for the other for as
long as it takes; --duration counts from their common start.

Algorithms (docs/design/algorithms.md; the two peers may use different ones):
  base            the paper's: the sum of the forces moves what both push, and what only the other
                  pushes is where it was heard to be
  dead-reckoning  the same, with the other's cube where it should be by now
  sep             the same, with the other hand's force as it should be by now
A FILE sets their parameters; --print-algorithm dead-reckoning prints one to start from.

Examples, each line in a terminal of its own. Two simulated hands, nothing between them:
  hapnet-peer --id 1 --listen 127.0.0.1:7101 --remote 127.0.0.1:7102 --task T3
  hapnet-peer --id 2 --listen 127.0.0.1:7102 --remote 127.0.0.1:7101 --task T3
With hapnet-emulator listening on ports 7001 and 7002 of this machine:
  hapnet-peer --id 1 --remote 127.0.0.1:7001 --task T3 --duration 20s --record a.rec
  hapnet-peer --id 2 --remote 127.0.0.1:7002 --task T3 --duration 20s --record b.rec
With a device in your hand (never run on the physical device; docs/use/hardware.md first), the three
other commands below first, then with little force:
  hapnet-peer --id 1 --remote 127.0.0.1:7001 --task T3 --device falcon --force-limit 500mN

Other commands, each with a --help of its own:
  hapnet-peer list-devices   every haptic device that is seen, and what keeps one from being used
  hapnet-peer doctor         what this machine grants to a haptic loop, and how to mend it
  hapnet-peer self-test      tries a device step by step, through the governor

Prints one line "ready ..." on stdout when its loop runs, and what happens on stderr.
SIGINT, SIGTERM, SIGHUP or hapnet-ctl SOCKET stop ends it with zero force and says goodbye to the
other peer.
Exit codes: 0 done, 1 the run failed, 2 bad usage, 3 the system refused (port in use, no route,
no such device).)";

constexpr double force_limit_max_n = 40.0; // more than any of the devices has

struct Texts {
    std::string id = "1";
    std::string listen = "127.0.0.1:0";
    std::string remote;
    DeviceTexts device;
    std::optional<std::string> scene;
    std::string grip_damping = "4Ns/m";
    std::string force_limit = "3.3N";
    std::string task = "P1";
    std::string algorithm = "base";
    std::optional<std::string> print_algorithm;
    std::string seed = "1";
    std::string duration = "30s";
    std::optional<std::string> key;
    bool insecure = false;
    std::optional<std::string> record;
    std::optional<std::string> stats;
    std::optional<std::string> control;
};

void add_options(CLI::App& app, Texts& texts)
{
    const auto add = [&app](const char* name, auto& text, const char* help, const char* type) {
        return app.add_option(name, text, help)->type_name(type);
    };
    add("--id", texts.id, "This peer's number; the lower is L (default 1)", "1..65535");
    add("--listen", texts.listen, "Where to receive (default 127.0.0.1:0, any free port)",
        "HOST:PORT");
    add("--remote", texts.remote, "The other peer, or the emulator's side for this one (required)",
        "HOST:PORT");
    add_device_options(app, texts.device);
    add("--scene", texts.scene,
        "A scene in TOML, or one of hapnet's by name (default: the task's; lift for T4, wall\n"
        "for T5, paper for the others); it has one movable body, which does not turn",
        "FILE|NAME");
    add("--grip-damping", texts.grip_damping,
        "Damping of the device and the loosest grip on it (default 4Ns/m, a nominal grip on\n"
        "a stylus): contacts that need more to be rendered safely feel softer",
        "DAMPING");
    add("--force-limit", texts.force_limit,
        "The most that the hand is given (default 3.3N, an Omni's peak; never more than the\n"
        "device has); 0N: nothing is felt. See docs/design/governor.md",
        "FORCE");
    add("--task", texts.task, "What the hands do, simulated or yours (default P1)", "P1|T1|...|T6");
    add("--algorithm", texts.algorithm,
        "How the two cubes are kept together: base (default), dead-reckoning, sep, or a file of\n"
        "parameters in TOML",
        "NAME|FILE");
    add("--print-algorithm", texts.print_algorithm,
        "Print an algorithm's parameters in TOML, with what each is for, and end", "NAME|FILE");
    add("--seed", texts.seed, "Of all chance in the hands; the lower id's counts (default 1)",
        "NUMBER");
    add("--duration", texts.duration, "Length of the session from its common start (default 30s)",
        "TIME");
    add("--key", texts.key, "Not available yet: authenticated sessions are still to come", "FILE");
    app.add_flag("--insecure", texts.insecure, "Allow a session without a key over a real network");
    add("--record", texts.record, "Write every tick and message to FILE (see hapnet-lab)", "FILE");
    add("--stats", texts.stats, "Write statistics to FILE at the end; - is stdout", "FILE");
    add("--control", texts.control,
        "Listen there for hapnet-ctl, which may ask how the session goes and stop it, and change\n"
        "nothing: hapnet-ctl SOCKET show|stats|watch|wait|stop",
        "SOCKET");
}

/// A damping that leaves something to be felt.
base::Result<double> parse_grip_damping(const std::string& text)
{
    auto damping = base::parse_quantity(text, base::damping_kind);
    if (damping && !(*damping > 0.0 && *damping <= scene::damping_max_ns_per_m)) {
        return base::fail(
            fmt::format("'{}' is out of range: more than 0, and at most {}, is possible", text,
                        base::quantity_text(scene::damping_max_ns_per_m, base::damping_kind)));
    }
    return damping;
}

base::Result<double> parse_force_limit(const std::string& text)
{
    auto force = base::parse_quantity(text, base::force_kind);
    if (force && !(*force >= 0.0 && *force <= force_limit_max_n)) {
        return base::fail(fmt::format("'{}' is out of range: 0N to {} is possible", text,
                                      base::quantity_text(force_limit_max_n, base::force_kind)));
    }
    return force;
}

/// A scene that two peers can share.
base::Result<scene::Description> scene_for_a_session(const std::string& file_or_name)
{
    auto scene = scene::load_scene(file_or_name, net::text_of_file);
    if (!scene) return scene;
    const auto body = shared_body(*scene);
    if (!body) return base::fail(fmt::format("{}: {}", file_or_name, body.error().message));
    return scene;
}

net::CommandLine<Options> algorithm_answer(const std::string& name_or_file)
{
    const auto algorithm = load_algorithm(name_or_file, net::text_of_file);
    if (!algorithm) {
        return base::fail(fmt::format("--print-algorithm: {}", algorithm.error().message));
    }
    return net::Answer{explain_algorithm(*algorithm)};
}

net::CommandLine<Options> options_from(const Texts& texts)
{
    Options options;
    Taker taker;
    taker.take(options.id, "--id", base::parse_count(texts.id, 65535));
    taker.require(options.id != 0, "--id: 0 is not a number of a peer; use 1 to 65535");
    taker.take(options.listen, "--listen", net::parse_host_port(texts.listen));
    taker.require(!texts.remote.empty(), "--remote is required: --remote 127.0.0.1:7001");
    taker.take(options.remote, "--remote", net::parse_host_port(texts.remote));
    taker.require(options.remote.port != 0, "--remote: needs a port");
    taker.take(options.task, "--task", device::task_named(texts.task));
    taker.take(options.algorithm, "--algorithm",
               load_algorithm(texts.algorithm, net::text_of_file));
    taker.take(options.seed, "--seed",
               base::parse_count(texts.seed, std::numeric_limits<std::uint64_t>::max()));
    taker.take(options.duration, "--duration", base::parse_duration(texts.duration));
    taker.require(options.duration >= std::chrono::seconds{1}, "--duration: at least 1s");
    take_device(options.device, taker, texts.device);
    options.scene_name = texts.scene.value_or(std::string{device::scene_of(options.task)});
    taker.take(options.scene, "--scene", scene_for_a_session(options.scene_name));
    taker.take(options.grip_damping_ns_per_m, "--grip-damping",
               parse_grip_damping(texts.grip_damping));
    taker.take(options.force_max_n, "--force-limit", parse_force_limit(texts.force_limit));
    taker.require(!texts.key, "--key: authenticated sessions are not available yet; use --insecure "
                              "on a network you trust");
    taker.require(texts.record != "-", "--record: '-' is not a file: a record needs one");
    if (taker.error()) return base::fail(*taker.error());
    options.insecure = texts.insecure;
    options.record = texts.record;
    options.stats = texts.stats;
    options.control = texts.control;
    return options;
}

} // namespace

net::CommandLine<Options> parse_options(std::span<char*> words)
{
    CLI::App app{description, "hapnet-peer"};
    Texts texts;
    add_options(app, texts);
    app.footer(footer);
    app.set_version_flag("--version", base::version_line("hapnet-peer"));
    try {
        app.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::CallForHelp&) {
        return net::Answer{app.help()};
    } catch (const CLI::CallForVersion&) {
        return net::Answer{base::version_line("hapnet-peer") + "\n"};
    } catch (const CLI::ParseError& error) {
        return base::fail(fmt::format("{}; see hapnet-peer --help", error.what()));
    }
    if (texts.print_algorithm) return algorithm_answer(*texts.print_algorithm);
    return options_from(texts);
}

} // namespace hapnet::peer

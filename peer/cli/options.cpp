// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/options.hpp"

#include "peer/core/shared_body.hpp"
#include "peer/core/sync/text.hpp"
#include "peer/shared_object/load.hpp"
#include "proto/base/quantity.hpp"
#include "proto/base/text.hpp"
#include "proto/cli/parsers.hpp"
#include "proto/cli/synonyms.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/text_file.hpp"
#include "scene/text/text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::peer {

namespace {

constexpr double force_limit_max_n = 40.0; // more than any of the devices can exert
constexpr double force_limit_min_n = 1e-3; // less than any hand feels
constexpr double grip_damping_min_ns_per_m = 1e-3;

/// Parses a damping that still lets contacts be felt.
base::Result<double> parse_grip_damping(const std::string& text)
{
    auto damping = base::parse_quantity(text, base::damping_kind);
    if (damping &&
        !(*damping >= grip_damping_min_ns_per_m && *damping <= scene::damping_max_ns_per_m)) {
        return base::fail(
            fmt::format("'{}' is out of range: more than 0 ({} or more), and at most {}, is "
                        "possible",
                        text, base::quantity_text(grip_damping_min_ns_per_m, base::damping_kind),
                        base::quantity_text(scene::damping_max_ns_per_m, base::damping_kind)));
    }
    return damping;
}

/// Parses a force limit: zero, or a force that can be felt.
base::Result<double> parse_force_limit(const std::string& text)
{
    auto force = base::parse_quantity(text, base::force_kind);
    const bool is_none = force && *force == 0.0;
    if (force && !is_none && !(*force >= force_limit_min_n && *force <= force_limit_max_n)) {
        return base::fail(fmt::format("'{}' is out of range: 0N to {} is possible, and {} the "
                                      "least above 0N",
                                      text,
                                      base::quantity_text(force_limit_max_n, base::force_kind),
                                      base::quantity_text(force_limit_min_n, base::force_kind)));
    }
    return force;
}

/// Parses how clocks are known. Where no error is given, it is the one that the system states.
base::Result<ClockPolicy> host_clock_policy(const std::string& text)
{
    auto policy = parse_clock_policy(text);
    const bool asks_system = policy && policy->synchronised_within == base::Duration{0};
    if (!asks_system) return policy;
    policy->synchronised_within = net::stated_clock_error();
    if (policy->synchronised_within > ClockPolicy::error_max)
        return base::fail(fmt::format("'{}': the system states an error of {}, and 1s is possible: "
                                      "give the largest error yourself: synchronised:2ms",
                                      text, base::to_text(*policy->synchronised_within)));
    if (!policy->synchronised_within)
        return base::fail(fmt::format("'{}': no service of this host keeps its clock: start one "
                                      "(chrony, ptp4l with phc2sys), or give the largest error "
                                      "yourself: synchronised:2ms",
                                      text));
    return policy;
}

/// Loads a scene, and refuses it if peers cannot share it.
base::Result<scene::Description> scene_for_a_session(const std::string& file_or_name)
{
    auto scene = scene::load_scene(file_or_name, net::text_of_file);
    if (!scene) return scene;
    const auto bodies = shared_bodies(*scene);
    if (!bodies) return base::fail(fmt::format("{}: {}", file_or_name, bodies.error().message));
    return scene;
}

/// Takes the scene of a session.
base::Result<void> take_scene(const std::string& file_or_name, Options& options)
{
    auto scene = scene_for_a_session(file_or_name);
    if (!scene) return tl::unexpected{scene.error()};
    options.scene_name = file_or_name;
    options.scene = *std::move(scene);
    return {};
}

base::Result<Algorithm> parse_algorithm_name(const std::string& name_or_file)
{
    return cli::meant_value("--algorithm", name_or_file).and_then([](const std::string& meant) {
        return load_algorithm(meant, net::text_of_file);
    });
}

base::Result<device::Task> parse_task(std::string name)
{
    for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return device::task_named(name);
}

base::Result<net::HostPort> parse_remote(const std::string& text)
{
    auto remote = net::parse_host_port(text);
    if (!remote || remote->port != 0) return remote;
    return base::fail(fmt::format("'{}': nothing can be sent to port 0; write the port that the "
                                  "other side listens on",
                                  text));
}

base::Result<std::string> parse_record(const std::string& file)
{
    if (file != "-" && !file.empty()) return file;
    return base::fail(fmt::format("'{}' is not a file: a record needs one", file));
}

base::Result<std::string> parse_result_file(const std::string& file)
{
    if (!file.empty()) return file;
    return base::fail("needs a file; - is stdout");
}

constexpr std::string_view evdev_prefix = "evdev:";

base::Result<std::string> parse_dead_man(const std::string& text)
{
    const bool is_evdev = text.starts_with(evdev_prefix) && text.size() > evdev_prefix.size();
    if (text == "button" || is_evdev) return text;
    return base::fail(fmt::format("'{}': write button, or evdev: and a device of the kernel, such "
                                  "as evdev:/dev/input/event5",
                                  text));
}

/// True if two names mean the same regular file, which need not exist yet.
bool is_one_file(const std::string& a, const std::string& b)
{
    std::error_code trouble;
    if (std::filesystem::exists(a, trouble) && std::filesystem::exists(b, trouble)) {
        return std::filesystem::is_regular_file(a, trouble) &&
               std::filesystem::equivalent(a, b, trouble);
    }
    return std::filesystem::weakly_canonical(a, trouble) ==
           std::filesystem::weakly_canonical(b, trouble);
}

base::Result<void> check_results(const Options& options)
{
    const std::array files{std::pair{"--record", &options.record},
                           std::pair{"--stats", &options.stats},
                           std::pair{"--events", &options.events}};
    for (std::size_t i = 0; i < files.size(); ++i) {
        for (std::size_t k = i + 1; k < files.size(); ++k) {
            const auto& [name, file] = files.at(i);
            const auto& [other_name, other] = files.at(k);
            if (!*file || !*other || !is_one_file(**file, **other)) continue;
            return base::fail(fmt::format("{} and {} are both {}: give each a file of its own",
                                          name, other_name, **file));
        }
    }
    return {};
}

/// Completes the ids of the peers and the addresses of the others.
base::Result<void> complete_peers(Options& options, const Asked& asked, const cli::Command& program)
{
    KeyedPlaces places{.named = asked.named, .place = {}};
    if (program.is_given("--remote")) places.place = asked.remote;
    auto others = find_others(options.key, places);
    if (!others) return tl::unexpected{others.error()};
    options.others = *std::move(others);
    if (!options.key.is_given()) return {};
    if (options.insecure) {
        return base::fail("--key and --insecure contradict each other: with a key nothing that is "
                          "not sealed is heard; leave out --insecure");
    }
    const std::uint8_t id = options.key.file->id;
    if (program.is_given("--id") && options.id != id) {
        return base::fail(fmt::format("--id {}: {} is the key of peer {}; leave out --id, or use "
                                      "that peer's file",
                                      options.id, options.key.path, id));
    }
    options.id = id;
    return {};
}

/// Refuses a scene without a hand for each peer. In a pair, one hand is enough if the algorithm
/// represents the other hand only by its force.
base::Result<void> check_room(const Options& options)
{
    const std::size_t all = options.others.size() + 1;
    const bool needs_all = has_hands_of_others(options.algorithm);
    if (options.scene.hands.count >= all || (options.is_pair() && !needs_all)) return {};
    return base::fail(fmt::format("--scene {} has room for {} hands ([hips] count), and {} peers "
                                  "are to play: use --task T7, or --scene carry",
                                  options.scene_name, options.scene.hands.count, all));
}

/// Refuses an algorithm that cannot play with this number of peers.
base::Result<void> check_company(const Options& options)
{
    if (options.is_pair() || plays_with_many(options.algorithm)) return {};
    return base::fail(fmt::format("--algorithm {} is for two peers: more than two play with "
                                  "another one, such as base or remote-proxy",
                                  name_of(options.algorithm)));
}

/// Refuses a number of peers that is not supported, and options that are not possible with this
/// number.
base::Result<void> check_circle(const Options& options)
{
    const std::size_t all = options.others.size() + 1;
    if (options.wait_for > all) {
        return base::fail(fmt::format("--wait-for {}: there are {} peers, this one counted; name "
                                      "the others with --peer",
                                      options.wait_for, all));
    }
    if (std::ranges::find(options.others, options.id, &NamedPeer::id) != options.others.end()) {
        return base::fail(fmt::format("--peer {}: this is the id of this peer itself: change "
                                      "--peer or --id",
                                      options.id));
    }
    if (options.is_pair()) return {};
    constexpr std::uint16_t id_max = secure::KeyFile::id_max;
    if (all > peers_max) {
        return base::fail(fmt::format("{} peers are named, this one counted: a session has {} at "
                                      "most; name those that play with --peer",
                                      all, peers_max));
    }
    if (options.id > id_max) {
        return base::fail(fmt::format("--id {}: among more than two peers ids are from 1 to {}",
                                      options.id, id_max));
    }
    return check_company(options);
}

base::Result<std::size_t> parse_wait_for(const std::string& text)
{
    if (text == "all") return std::size_t{0};
    const auto count = base::parse_count(text, peers_max);
    if (count && *count >= 2) return static_cast<std::size_t>(*count);
    return base::fail(fmt::format("'{}': write all, or a number from 2 to {}", text, peers_max));
}

void add_results(cli::Command& program, Options& options)
{
    program.option("--record", "FILE", "Write every tick and message to FILE (see hapnet-lab)",
                   cli::into(options.record, parse_record));
    program.option("--stats", "FILE", "Write statistics to FILE at the end; - is stdout",
                   cli::into(options.stats, parse_result_file));
    program.option(
        "--events", "FILE",
        "Write a line of JSON to FILE for whatever happens (docs/formats/events.md); - is stdout",
        cli::into(options.events, parse_result_file));
    program.option("--control", "SOCKET",
                   "Listen on this Unix socket for hapnet-ctl, which may show the session and "
                   "stop it, and change nothing: hapnet-ctl SOCKET "
                   "show|stats|metrics|watch|wait|keep|stop|estop",
                   cli::into(options.control));
    program.option("--plotjuggler", "HOST:PORT",
                   "Send 50 frames a second as JSON over UDP, as PlotJuggler's UDP server takes "
                   "them (docs/formats/live.md); not sealed, also with --key",
                   cli::into(options.plot, parse_remote));
    cli::add_keep(program, options.keep, "what --record would write");
}

} // namespace

/// Adds the options that limit the force on the hand.
void add_force_options(cli::Command& program, Options& options)
{
    program.option(
        "--grip-damping", "DAMPING",
        "The least damping of device and hand together. A contact that needs more than "
        "this to be passive is rendered softer (default 4Ns/m, a nominal grip on a stylus)",
        cli::into(options.grip_damping_ns_per_m, parse_grip_damping));
    program.option("--force-limit", "FORCE",
                   "Maximum force on the hand; 0N: no force (default 3.3N, an Omni's peak; never "
                   "more than the device allows). See docs/design/governor.md",
                   cli::into(options.force_max_n, parse_force_limit));
    program.option("--dead-man", "button|evdev:DEVICE",
                   "Force only while a button of the haptic device is held, or a key of an input "
                   "device such as a foot switch (evdev:/dev/input/event5), which is grabbed",
                   cli::into(options.dead_man, parse_dead_man));
}

/// Adds the options for the peers and their addresses.
void add_peer_options(cli::Command& program, Options& options, Asked& asked)
{
    constexpr std::uint64_t id_max = 65535;
    program.option("--id", "1..65535",
                   "Number of this peer, different for all; the lower one of two is A. With a key, "
                   "or among more than two, 1 to 31 (default 1, or the one in the key file)",
                   cli::into(options.id, base::Count{1, id_max}));
    program.option("--listen", "ADDRESS",
                   "Where to receive: HOST:PORT; :PORT listens on loopback (default 127.0.0.1:0, "
                   "any free port)",
                   cli::into(options.listen, net::parse_listen_address));
    program.option("--remote", "HOST:PORT",
                   "The other peer, or the emulator's address for this side; needed unless --peer "
                   "or the key file says it",
                   cli::into(asked.remote, parse_remote));
    program
        .option("--peer", "ID=HOST:PORT",
                "Another peer with its id, 1 to 31, in place of --remote; once for each of up to "
                "seven others",
                [&asked](const std::string& text) {
                    return parse_named_peer(text).map(
                        [&asked](NamedPeer peer) { asked.named.push_back(std::move(peer)); });
                })
        .repeated();
    program.option("--wait-for", "all|N",
                   "Start when all peers named here hear each other (default), or when N of them "
                   "do, this one included. What the peer with the lowest id says holds; those "
                   "that come later join late",
                   cli::into(options.wait_for, parse_wait_for));
}

void add_session_options(cli::Command& program, Options& options, Asked& asked)
{
    add_peer_options(program, options, asked);
    program.option(
        "--scene", "FILE|NAME",
        "A scene in TOML, or a built-in one by name; at most 8 of its bodies are movable "
        "(default: the task's; lift for T4, wall for T5, carry for T7, turning for T8, "
        "stack-of-three for T9, bench for T10, paper for the others; carry for T1, T2 and T3 of "
        "more than two)",
        [&options](const std::string& text) { return take_scene(text, options); });
    add_force_options(program, options);
    program.option("--task", "P1|T1|...|T10", "What the hands do, simulated or yours (default P1)",
                   cli::into(options.task, parse_task));
    program.option(
        "--algorithm", "NAME|FILE",
        "How the copies of the cube are kept together: base (default), dead-reckoning, sep, "
        "remote-proxy, base-tdpa, wave, couple, lag, rollback, a file of parameters in TOML, or a "
        "shared object of your own (FILE.so)",
        cli::into(options.algorithm, parse_algorithm_name));
    program
        .option("--print-algorithm", "NAME|FILE",
                "Print the parameters of an algorithm in TOML, with their meaning, and exit",
                cli::into(asked.printed_algorithm,
                          [](const std::string& text) {
                              return parse_algorithm_name(text).map(explain_algorithm);
                          }))
        .instead();
    program.option("--send", "every:N|deadband:P%[,TIME]",
                   "When a message is sent: every N ticks of 1 ms (default every:1), or when what "
                   "the others can predict is off by P percent, and after TIME of silence (default "
                   "50ms). All peers of a session should have the same",
                   cli::into(options.send, parse_send_policy));
    program.option(
        "--playout", "none|adaptive",
        "When a message that has arrived counts: at once (none, the default), or evenly, "
        "as they were sent, after a delay that follows the path's jitter (adaptive)",
        cli::into(options.playout, cli::named<Playout>));
    program.option("--clock", "echo|synchronised[:ERROR]",
                   "How the others' clocks are known: by echoes in messages (echo, the default), "
                   "or because NTP or PTP keeps this host's clock and theirs within ERROR "
                   "(synchronised; without ERROR the one that the system states). Helps where one "
                   "way takes longer than the other. Counts where both peers have it",
                   cli::into(options.clock, host_clock_policy));
    program.option("--seed", "NUMBER",
                   "Seed for every random draw of the hands; the lower id's counts (default 1)",
                   cli::into(options.seed, cli::seed));
    program.option("--duration", "TIME",
                   "Length of the session from its common start (default 30s)",
                   cli::into(options.duration, base::Time{std::chrono::seconds{1}}));
    add_key_options(program, options.key);
    program.flag("--insecure",
                 "Allow a session without a key over a real network, where any host that can send "
                 "here can then move this hand",
                 options.insecure);
    program.flag("--untested-device",
                 "Allow a session on a real device that has not passed a self-test in the last 30 "
                 "days",
                 options.untested_device);
    add_results(program, options);
    add_device_options(program, options.device);
}

base::Result<void> complete(Options& options, const Asked& asked, const cli::Command& program)
{
    if (auto fine = complete_peers(options, asked, program); !fine) return fine;
    if (auto fine = check_device_options(program, options.device); !fine) return fine;
    if (auto fine = check_results(options); !fine) return fine;
    if (auto fine = cli::check_keep(options.keep, options.control.has_value()); !fine) return fine;
    if (!program.is_given("--scene")) {
        const std::size_t peers = options.is_pair() ? 2 : 1 + options.others.size();
        const auto scene = device::scene_of(options.task, peers);
        const auto taken = take_scene(std::string{scene}, options);
        if (!taken) return base::fail(fmt::format("--scene: {}", taken.error().message));
    }
    const auto played = check_bodies_of(options.algorithm, shared_bodies(options.scene).value());
    if (!played) return base::fail(fmt::format("--algorithm: {}", played.error().message));
    const auto felt = check_hands_of(options.algorithm, options.scene.hands);
    if (!felt) return base::fail(fmt::format("--algorithm: {}", felt.error().message));
    if (auto fine = check_circle(options); !fine) return fine;
    return check_room(options);
}

base::Result<void> load_code(Options& options)
{
    if (auto loaded = shared_object::load(options.algorithm); !loaded) {
        return base::fail(fmt::format("--algorithm: {}", loaded.error().message));
    }
    return check_company(options); // only loaded code has plays_with_many
}

} // namespace hapnet::peer

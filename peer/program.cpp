// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/program.hpp"

#include "device/governor/limits_text.hpp"
#include "device/rig.hpp"
#include "peer/cli/chosen_device.hpp"
#include "peer/cli/commands.hpp"
#include "peer/cli/options.hpp"
#include "peer/core/energy_budget.hpp"
#include "peer/core/sync/text.hpp"
#include "peer/device_state/kept_device.hpp"
#include "peer/loop/servo.hpp"
#include "peer/loop/supervise.hpp"
#include "peer/monitor/control_session.hpp"
#include "peer/monitor/event_log.hpp"
#include "peer/monitor/monitor.hpp"
#include "peer/monitor/report.hpp"
#include "proto/base/visible.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/crash_signal.hpp"
#include "proto/net/program.hpp"
#include "proto/net/service_manager.hpp"
#include "proto/net/stop_signal.hpp"
#include "proto/net/text_queue.hpp"
#include "proto/secure/keys/draw.hpp"

#include <algorithm>
#include <cstring>
#include <memory>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <unistd.h>
#include <utility>
#include <vector>

namespace hapnet::peer {

namespace {

constexpr std::string_view program = "hapnet-peer";

/// The time after a stop at which the process ends in any case. An orderly end takes a tenth of it.
constexpr base::Duration gone_after{std::chrono::milliseconds{800}};

/// The text queues of stdout and stderr. Their readers may be slow or absent.
struct Screen {
    net::TextQueue out{STDOUT_FILENO};
    net::TextQueue err{STDERR_FILENO};

    void say(std::string_view text)
    {
        err.put(fmt::format("{}: {}\n", program, base::visible_lines(text)));
    }
    [[nodiscard]] std::uint64_t lost() const { return err.lost() + out.lost(); }
};

/// The control socket and the statistics file, if the options name them.
struct Outlets {
    explicit Outlets(const Options& options)
    {
        if (options.control) server.emplace(*options.control, monitor::ControlSession::limits);
        if (options.stats && *options.stats != "-") statistics.emplace(*options.stats, "--stats");
    }

    std::optional<control::Server> server;
    std::optional<disk::ResultFile> statistics;
};

struct Endpoints {
    net::Endpoint listen;
    std::vector<net::Endpoint> remotes; // in the order of Options::others
    std::optional<net::Endpoint> plot{};
};

/// Resolves the remote, preferably in the family of `listen`, because a name may have addresses of
/// both families.
net::Endpoint resolve_remote(const net::HostPort& remote, const net::Endpoint& listen)
{
    try {
        return net::resolve(remote, listen.family());
    } catch (const std::system_error&) {
        return net::resolve(remote);
    }
}

/// Returns the option by which the command line names the place of another peer.
std::string option_of(const Options& options, const NamedPeer& other)
{
    return options.is_pair() ? "--remote" : fmt::format("--peer {}:", other.id);
}

/// Refuses addresses between which no datagrams can be sent: `listen` and that of another peer.
base::Result<void> check_remote(const net::Endpoint& listen, const net::Endpoint& remote,
                                const std::string& option)
{
    if (listen.family() != remote.family()) {
        return base::fail(fmt::format(
            "--listen {} and {} {} are of different families: give both as IPv4 or as IPv6",
            listen.to_text(), option, remote.to_text()));
    }
    if (remote.reaches(listen)) {
        return base::fail(fmt::format("{} {} is where this peer itself listens: name the "
                                      "other peer's address, or the emulator's",
                                      option, remote.to_text()));
    }
    if (listen.is_loopback() && !remote.is_loopback()) {
        const std::uint16_t given = listen.port();
        return base::fail(fmt::format(
            "{} {} cannot be reached from --listen {}: use --listen {}:{}, or an address of "
            "this machine that the other side can reach",
            option, remote.to_text(), listen.to_text(),
            listen.family() == AF_INET6 ? "[::]" : "0.0.0.0", given != 0 ? given : remote.port()));
    }
    if (!remote.is_one_host()) {
        return base::fail(fmt::format("{} {} is not the address of one host, and no answer "
                                      "can come from it: name the other peer's own address",
                                      option, remote.to_text()));
    }
    return {};
}

base::Result<void> check_key_is_there(const Options& options, const Endpoints& endpoints)
{
    const bool is_local = endpoints.listen.is_loopback() &&
                          std::ranges::all_of(endpoints.remotes, &net::Endpoint::is_loopback);
    if (is_local || options.key.is_given() || options.insecure) return {};
    return base::fail(fmt::format(
        "a session over a network needs a key: make one for each host with 'hapnet-peer keygen "
        "--peers {} --out keys' and give each its own file with --key FILE; or use --insecure "
        "on a network where you trust every host",
        options.others.size() + 1));
}

base::Result<Endpoints> look_up(const Options& options)
{
    Endpoints endpoints{net::resolve(options.listen), {}};
    if (options.plot) endpoints.plot = net::resolve(*options.plot);
    for (const NamedPeer& other : options.others) {
        const net::Endpoint remote = resolve_remote(other.place, endpoints.listen);
        if (std::ranges::find(endpoints.remotes, remote) != endpoints.remotes.end()) {
            return base::fail(fmt::format("--peer {}: another peer is said to be at {}, too: each "
                                          "has an address of its own, also at the emulator",
                                          other.id, remote.to_text()));
        }
        endpoints.remotes.push_back(remote);
    }
    if (auto fine = check_key_is_there(options, endpoints); !fine)
        return tl::unexpected{fine.error()};
    for (std::size_t i = 0; i < endpoints.remotes.size(); ++i) {
        const auto& remote = endpoints.remotes[i];
        auto fine = check_remote(endpoints.listen, remote, option_of(options, options.others[i]));
        if (!fine) return tl::unexpected{fine.error()};
        net::require_route(endpoints.listen, remote);
    }
    return endpoints;
}

Settings settings_of(const Options& options, const device::Rig& rig)
{
    const device::Mount& mount = rig.mount();
    Settings settings;
    settings.introduction.id = options.id;
    settings.roster = options.roster();
    settings.introduction.nonce = static_cast<std::uint32_t>(net::unpredictable_bits() | 1U);
    settings.introduction.scene_hash = scene::hash(options.scene);
    settings.introduction.seed = options.seed.value();
    settings.introduction.clock = clock_hash(options.clock, net::boot_id());
    settings.introduction.clock_error =
        options.clock.synchronised_within.value_or(base::Duration{});
    settings.introduction.task = wire::TaskName::from_text(device::name_of(options.task)).value();
    settings.introduction.hand = hand_model_of(rig.device().capabilities());
    settings.scene = options.scene;
    settings.algorithm = options.algorithm;
    settings.send = options.send;
    settings.playout = options.playout;
    // At the hand, the scene's springs and dampers are both stiffer by the scale squared.
    settings.grip_damping_ns_per_m = options.grip_damping_ns_per_m / (mount.scale * mount.scale);
    // A simulated hand cannot be hurt, so its stiffness is not limited.
    if (options.device.is_real()) {
        settings.stiffness_max_n_per_m =
            rig.device().capabilities().stiffness_max_n_per_m / (mount.scale * mount.scale);
    }
    settings.mount_scale = mount.scale;
    settings.length = options.duration;
    settings.measures_paths = true;
    return settings;
}

/// Returns the lines to the other peers, sealed with the key that the options name.
line::Lines lines_of(const Options& options, const std::vector<net::Endpoint>& remotes,
                     std::uint32_t run)
{
    std::vector<line::Line> lines;
    for (std::size_t i = 0; i < remotes.size(); ++i) {
        if (!options.key.is_given()) {
            lines.emplace_back(remotes[i].packed());
            continue;
        }
        const secure::KeyFile& file = *options.key.file;
        secure::Association::Config config;
        config.own_id = file.id;
        config.other_id = options.others[i].id;
        config.circle = file.circle();
        config.run = run;
        config.place = remotes[i].packed();
        config.may_roam = !options.key.stays;
        lines.emplace_back(std::make_unique<line::Sealed>(
            config, file.keys_with(*file.find(config.other_id)), secure::keys::draw()));
    }
    return line::Lines{std::move(lines)};
}

/// Returns the limits of a session, without those of the device itself.
device::GovernorLimits limits_of(const Options& options, const device::Capabilities& capabilities,
                                 const std::optional<device_state::KeptDevice>& kept)
{
    device::GovernorLimits limits{.force_max_n = options.force_max_n,
                                  .checks_motion = options.device.is_real(),
                                  .energy = energy_budget(capabilities, options.algorithm)};
    if (kept) limits.heat_start = kept->heat_at_start(limits.heat_time);
    return limits;
}

/// Returns the layout of the records of sessions in this scene: the longest message is a state with
/// all its shared bodies, or a hello.
record::Layout layout_for(const scene::Description& scene)
{
    wire::State state;
    state.sequence = 1;
    for (const scene::BodyDescription& body : scene.bodies) {
        if (!body.movable || state.bodies.size() == wire::bodies_max) continue;
        wire::BodyState shared;
        shared.body = static_cast<std::uint16_t>(state.bodies.size());
        if (body.turning != scene::Turning::locked) shared.turning.emplace();
        state.bodies.add(shared);
    }
    wire::Hello hello;
    hello.nonce = 1;
    hello.peer_id = 1;
    hello.task = wire::TaskName::from_text("T7").value();
    const auto layout = record::Layout::for_messages_of(
        std::max(wire::encode(state).bytes().size(), wire::encode(hello).bytes().size()));
    const bool is_one = state.bodies.size() == 1 && !state.bodies.first()->turning;
    return is_one ? layout : layout.with_bodies();
}

monitor::Recorder::Setup recording_for(const Options& options, std::string_view device,
                                       const device::Rig& rig, const Settings& settings)
{
    nlohmann::json configuration = monitor::configuration_json(options, device);
    configuration["started_unix_s"] = net::wall_clock_seconds();
    // The number of the session is computed from it.
    configuration["nonce"] = settings.introduction.nonce;
    configuration["grip_damping_ns_per_m"] = settings.grip_damping_ns_per_m; // in the scene's scale
    configuration["stiffness_max_n_per_m"] = settings.stiffness_max_n_per_m; // in the scene's scale
    const device::Mount& mount = rig.mount();
    const glm::dvec3& offset = mount.offset.value;
    configuration["mount"] = {{"offset_m", {offset.x, offset.y, offset.z}}, {"scale", mount.scale}};
    configuration["governor_toml"] = device::print_limits(rig.governor().limits());
    const record::Layout layout = layout_for(options.scene);
    std::optional<record::Writer> writer;
    if (options.record) writer.emplace(*options.record, configuration, layout);
    return {.writer = std::move(writer),
            .config = std::move(configuration),
            .layout = layout,
            .held = options.keep.span,
            .keep_in = options.keep.folder};
}

/// Returns the names for texts to a person.
monitor::Named named_in(const Settings& settings)
{
    monitor::Named named{.peer_id = settings.introduction.id, .others = settings.roster.others};
    const auto bodies = shared_bodies(settings.scene).value();
    const std::string& name = settings.scene.bodies[bodies.front().id].name;
    if (!name.empty()) named.body = name;
    named.has_several = bodies.size() > 1;
    return named;
}

/// Describes a real device to its holder, and says which of the requested forces it cannot render.
void introduce(const Options& options, const device::Rig& rig, Screen& screen)
{
    if (options.device.is_real()) {
        screen.say(introduction(rig.device(), rig.mount(), options.task));
        const std::string softer = note_on_stiffness(rig.device().capabilities(), rig.mount(),
                                                     options.scene.hands.stiffness_n_per_m);
        if (!softer.empty()) screen.say(softer);
    }
    if (options.force_max_n == Options{}.force_max_n) return;
    const std::string lower =
        note_on_force_limit(options.force_max_n, rig.governor().limits().force_max_n);
    if (!lower.empty()) screen.say(lower);
}

/// Returns the reason why a device may not be used in a session; "" when it may.
std::string refusal_of_untested(const Options& options,
                                const std::optional<device_state::KeptDevice>& kept)
{
    if (!kept || options.untested_device || kept->why_untested().empty()) return {};
    return fmt::format("{}: {}: run 'hapnet-peer self-test --device {}', or allow it with "
                       "--untested-device",
                       options.device.name, kept->why_untested(), options.device.name);
}

loop::DeadMan dead_man_of(const Options& options)
{
    if (!options.dead_man) return {};
    if (*options.dead_man == "button") return loop::DeadMan{loop::DeviceButton{}};
    return loop::DeadMan{loop::EvdevSwitch{options.dead_man->substr(std::strlen("evdev:"))}};
}

std::string ready_line(const Options& options, const net::UdpSocket& socket,
                       const std::vector<net::Endpoint>& remotes)
{
    std::string others = "remote=" + remotes.front().to_text();
    if (!options.is_pair()) {
        others = "peers";
        for (std::size_t i = 0; i < remotes.size(); ++i) {
            others += fmt::format("{}{}={}", i == 0 ? "=" : ",", options.others[i].id,
                                  remotes[i].to_text());
        }
    }
    return fmt::format("ready id={} listen={} {} task={} algorithm={} seed={}\n", options.id,
                       socket.local().to_text(), others, device::name_of(options.task),
                       name_of(options.algorithm), options.seed.value());
}

/// Writes the statistics. If they cannot be written to their file, they are printed on stdout, so
/// that they are not lost. Returns the exit code.
int write_statistics(const monitor::Run& run, std::optional<disk::ResultFile>& file, Screen& screen)
{
    if (!run.options.stats) return 0;
    const std::string statistics = statistics_json(run).dump(2) + "\n";
    int code = 0;
    try {
        if (file) file->commit(statistics);
    } catch (const std::system_error& error) {
        screen.say(net::explained(error));
        code = net::exit_environment;
    }
    if (!file || code != 0) screen.out.put(statistics);
    return code;
}

/// Prints the result of the run, and returns its exit code.
int conclude(const monitor::Run& run, const device::Governor& governor, Screen& screen)
{
    screen.err.put(base::visible_lines(summary(run)));
    if (const auto reason = run.status.refusal) {
        screen.say(
            fmt::format("refused: the two peers do not match: {}", monitor::describe(*reason)));
        return net::exit_failed;
    }
    if (const std::string fault = monitor::fault_at_the_end(governor); !fault.empty()) {
        screen.say(fault);
        return net::exit_failed;
    }
    return run.options.record && !run.is_record_whole ? net::exit_environment : 0;
}

/// Waits for the reader of the program's output, but not forever. Output that could not be printed
/// is an error.
int finish(int code, const Screen& screen, const net::StopSignal& stop)
{
    loop::wait_for_readers(screen.out, stop);
    loop::wait_for_readers(screen.err, stop);
    if (const int error = screen.out.error(); error != 0) {
        throw std::system_error{error, std::generic_category(), "cannot write the output"};
    }
    return code == 0 && (!screen.out.is_done() || screen.out.lost() > 0) ? net::exit_environment
                                                                         : code;
}

/// Finishes the events, unless they are part of the program's own output. Returns the exit code
/// that they cause.
int finish_events(const std::optional<monitor::EventLog>& events, Screen& screen,
                  const net::StopSignal& stop)
{
    if (!events || &events->queue() == &screen.out) return 0;
    const net::TextQueue& queue = events->queue();
    loop::wait_for_readers(queue, stop);
    if (queue.is_done() && queue.lost() == 0) return 0;
    screen.say(fmt::format("--events: some are missing: {}", queue.error() != 0
                                                                 ? std::strerror(queue.error())
                                                                 : "its reader did not take them"));
    return net::exit_environment;
}

/// Returns the log to the file that the options name, which is emptied, or to stdout.
std::optional<monitor::EventLog> events_for(const Options& options, Screen& screen)
{
    if (!options.events) return std::nullopt;
    return std::optional<monitor::EventLog>{std::in_place, *options.events, screen.out};
}

/// Returns the stream to the plotter, if there is one.
std::optional<monitor::PlotStream> plot_for(const std::optional<net::Endpoint>& plotter,
                                            std::uint16_t id, monitor::Monitor& monitor)
{
    if (!plotter) return std::nullopt;
    return std::optional<monitor::PlotStream>{std::in_place, *plotter, id, monitor.watch_frames()};
}

/// Returns the input of reports, without lost texts.
monitor::Run run_of(const Options& options, const loop::ServoStatus& status,
                    const std::string& device, const monitor::Monitor& monitor)
{
    return {.options = options,
            .status = status,
            .device = device,
            .is_record_whole = monitor.is_record_whole(),
            .rows_lost = monitor.rows_lost(),
            .are_events_whole = monitor.are_events_whole()};
}

/// Runs a session, from opening the device to writing the files.
int play(const Options& options, const Endpoints& endpoints, const net::StopSignal& stop)
{
    net::ServiceManager manager;
    stop.enforce(gone_after, net::exit_environment);
    Screen screen;
    const net::CrashSignal crash;
    const net::CrashStack stack;
    net::UdpSocket socket{endpoints.listen};
    Outlets outlets{options}; // before the device is touched
    loop::ForceGate gate{stop, dead_man_of(options)};
    auto opened = open_chosen(options.device, options.task);
    if (!opened) {
        screen.say(describe_open_error(options.device, opened.error()));
        return finish(net::exit_environment, screen, stop);
    }
    const device::Mount mount = mount_of(options.device, (*opened)->capabilities());
    auto kept = kept_of(options.device, **opened);
    if (const std::string why = refusal_of_untested(options, kept); !why.empty()) {
        screen.say(why);
        return finish(net::exit_environment, screen, stop);
    }
    const device::GovernorLimits limits = limits_of(options, (*opened)->capabilities(), kept);
    if (kept) kept->on_use();
    device::Rig rig{*std::move(opened), limits, mount};
    const std::string device = device::description(rig.device());
    introduce(options, rig, screen);
    const Settings settings = settings_of(options, rig);
    loop::Journal journal;
    Side side{settings};
    loop::Watchdog watchdog{rig.device(), &crash};
    line::Lines lines = lines_of(options, endpoints.remotes, settings.introduction.nonce);
    loop::Servo servo{{side, rig, socket, endpoints.remotes, lines, journal, watchdog, gate,
                       std::chrono::milliseconds{1}, layout_for(options.scene)}};
    // This is the last step that may fail, because it empties the files.
    auto events = events_for(options, screen);
    monitor::Monitor monitor{journal, screen.err, recording_for(options, device, rig, settings),
                             named_in(settings), events ? &*events : nullptr};

    std::optional<monitor::ControlSession> control_session;
    if (auto& server = outlets.server) {
        control_session.emplace(monitor::ControlSession::Parts{*server, servo, stop, gate, options,
                                                               monitor, device,
                                                               monitor::recovery_of(rig.device())});
    }
    auto plot = plot_for(endpoints.plot, options.id, monitor);
    loop::supervise({servo, monitor, stop, gate, screen.out, screen.err,
                     control_session ? &*control_session : nullptr, plot ? &*plot : nullptr,
                     &manager},
                    ready_line(options, socket, endpoints.remotes));

    if (kept) kept->on_rest(rig.governor().heat());
    const loop::ServoStatus status = servo.status();
    const int events_code = finish_events(events, screen, stop);
    monitor::Run run = run_of(options, status, device, monitor);
    run.texts_lost = screen.lost();
    const int written = write_statistics(run, outlets.statistics, screen);
    const int code = std::max({events_code, written, conclude(run, rig.governor(), screen)});
    return finish(code, screen, stop);
}

base::Result<int> run(Options options)
{
    if (options.clock.synchronised_within) net::count_from_common_date();
    const auto endpoints = look_up(options);
    if (!endpoints) return tl::unexpected{endpoints.error()};
    const net::StopSignal stop; // must exist before any thread starts
    if (const auto loaded = load_code(options); !loaded) return tl::unexpected{loaded.error()};
    return play(options, *endpoints, stop);
}

base::Result<int> execute(const Command& command)
{
    return std::visit([](const auto& chosen) { return run(chosen); }, command);
}

} // namespace

int main_program(std::span<char*> words)
{
    return net::run_program(program, parse_command_line(words), execute);
}

} // namespace hapnet::peer

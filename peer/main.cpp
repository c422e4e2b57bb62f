// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
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
#include "peer/monitor/monitor.hpp"
#include "peer/monitor/report.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/crash_signal.hpp"
#include "proto/net/program.hpp"
#include "proto/net/result_file.hpp"
#include "proto/net/stop_signal.hpp"

#include <memory>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer {

namespace {

constexpr std::string_view program = "hapnet-peer";

void say(std::string_view text) { net::say(program, text); }

struct Endpoints {
    net::Endpoint listen;
    net::Endpoint remote;
};

/// The remote, preferably in the family of `listen`: a name may have addresses of both.
net::Endpoint resolve_remote(const net::HostPort& remote, const net::Endpoint& listen)
{
    try {
        return net::resolve(remote, listen.family());
    } catch (const std::system_error&) {
        return net::resolve(remote);
    }
}

base::Result<Endpoints> look_up(const Options& options)
{
    const net::Endpoint listen = net::resolve(options.listen);
    const Endpoints endpoints{listen, resolve_remote(options.remote, listen)};
    if (endpoints.listen.family() != endpoints.remote.family()) {
        return base::fail(fmt::format(
            "--listen {} and --remote {} are of different families: give both as IPv4 or as IPv6",
            endpoints.listen.to_text(), endpoints.remote.to_text()));
    }
    if (endpoints.remote.reaches(endpoints.listen)) {
        return base::fail(fmt::format("--remote {} is where this peer itself listens: name the "
                                      "other peer's address, or the emulator's",
                                      endpoints.remote.to_text()));
    }
    if (!options.insecure && !(endpoints.remote.is_loopback() && endpoints.listen.is_loopback())) {
        return base::fail(
            "forces from a network need a key, and keys are not available yet: on a network that "
            "you trust use --insecure, otherwise keep --listen and --remote on loopback");
    }
    if (endpoints.listen.is_loopback() && !endpoints.remote.is_loopback()) {
        const std::uint16_t given = endpoints.listen.port();
        return base::fail(fmt::format(
            "--remote {} cannot be reached from --listen {}: use --listen {}:{}, or an address of "
            "this machine that the other side can reach",
            endpoints.remote.to_text(), endpoints.listen.to_text(),
            endpoints.listen.family() == AF_INET6 ? "[::]" : "0.0.0.0",
            given != 0 ? given : endpoints.remote.port()));
    }
    net::require_route(endpoints.remote);
    return endpoints;
}

Settings settings_of(const Options& options, const device::Rig& rig)
{
    const device::Mount& mount = rig.mount();
    Settings settings;
    settings.introduction.id = options.id;
    settings.introduction.nonce = static_cast<std::uint32_t>(net::unpredictable_bits() | 1U);
    settings.introduction.scene_hash = scene::hash(options.scene);
    settings.introduction.seed = options.seed.value();
    settings.introduction.task = wire::TaskName::from_text(device::name_of(options.task)).value();
    settings.scene = options.scene;
    settings.algorithm = options.algorithm;
    // The scene's springs are as much stiffer at the hand as its dampers: by the scale squared.
    settings.grip_damping_ns_per_m = options.grip_damping_ns_per_m / (mount.scale * mount.scale);
    // A simulated hand cannot be hurt, and the experiments that it plays are told without that.
    if (options.device.is_real()) {
        settings.stiffness_max_n_per_m =
            rig.device().capabilities().stiffness_max_n_per_m / (mount.scale * mount.scale);
    }
    settings.length = options.duration;
    return settings;
}

/// The limits of a session, before those of the device itself.
device::GovernorLimits limits_of(const Options& options, const device::Capabilities& capabilities,
                                 const std::optional<device_state::KeptDevice>& kept)
{
    device::GovernorLimits limits{.force_max_n = options.force_max_n,
                                  .checks_motion = options.device.is_real(),
                                  .energy = energy_budget(capabilities, options.algorithm)};
    if (kept) limits.heat_start = kept->heat_at_start(limits.heat_time);
    return limits;
}

std::optional<record::Writer> writer_for(const Options& options, std::string_view device,
                                         const device::Rig& rig, const Settings& settings)
{
    if (!options.record) return std::nullopt;
    nlohmann::json configuration = monitor::configuration_json(options, device);
    // The session's number follows from it.
    configuration["nonce"] = settings.introduction.nonce;
    configuration["grip_damping_ns_per_m"] = settings.grip_damping_ns_per_m; // as in the scene
    configuration["stiffness_max_n_per_m"] = settings.stiffness_max_n_per_m; // likewise
    const device::Mount& mount = rig.mount();
    const glm::dvec3& offset = mount.offset.value;
    configuration["mount"] = {{"offset_m", {offset.x, offset.y, offset.z}}, {"scale", mount.scale}};
    configuration["governor_toml"] = device::print_limits(rig.governor().limits());
    return record::Writer{*options.record, configuration};
}

/// Introduces a real device to its holder, and says which forces of the scene it cannot render.
void introduce(const Options& options, const device::Rig& rig)
{
    say(introduction(rig.device(), rig.mount(), options.task));
    const std::string softer = note_on_stiffness(rig.device().capabilities(), rig.mount(),
                                                 options.scene.hands.stiffness_n_per_m);
    if (!softer.empty()) say(softer);
}

std::string ready_line(const Options& options, const net::UdpSocket& socket,
                       const net::Endpoint& remote)
{
    return fmt::format("ready id={} listen={} remote={} task={} algorithm={} seed={}\n", options.id,
                       socket.local().to_text(), remote.to_text(), device::name_of(options.task),
                       name_of(options.algorithm), options.seed.value());
}

void write_statistics(const monitor::Run& run, std::optional<net::ResultFile>& file)
{
    const std::string statistics = statistics_json(run).dump(2) + "\n";
    if (file) {
        file->commit(statistics);
    } else if (run.options.stats) {
        fmt::print("{}", statistics);
    }
}

/// Tells how the run went; its exit code.
int conclude(const monitor::Run& run, const device::Governor& governor,
             const monitor::Monitor& monitor)
{
    net::tell(summary(run));
    if (const auto reason = run.status.refusal) {
        say(fmt::format("refused: the two peers do not match: {}", monitor::describe(*reason)));
        return net::exit_failed;
    }
    if (const std::string fault = monitor::fault_at_the_end(governor); !fault.empty()) {
        say(fault);
        return net::exit_failed;
    }
    if (const auto failure = monitor.record_failure()) std::rethrow_exception(failure);
    return 0;
}

base::Result<int> run(const Options& options)
{
    const auto endpoints = look_up(options);
    if (!endpoints) return tl::unexpected{endpoints.error()};
    net::StopSignal stop; // before any thread
    const net::CrashSignal crash;
    const net::CrashStack stack;
    net::UdpSocket socket{endpoints->listen};
    std::optional<control::Server> server; // before the device is touched
    if (options.control) server.emplace(*options.control, monitor::ControlSession::limits);
    auto opened = open_chosen(options.device, options.task);
    if (!opened) {
        say(describe_open_error(options.device, opened.error()));
        return net::exit_environment;
    }
    const device::Mount mount = mount_of(options.device, (*opened)->capabilities());
    auto kept = kept_of(options.device, **opened);
    if (kept && !options.untested_device && !kept->why_untested().empty()) {
        say(fmt::format("{}: {}: run 'hapnet-peer self-test --device {}', or allow it with "
                        "--untested-device",
                        options.device.name, kept->why_untested(), options.device.name));
        return net::exit_environment;
    }
    const device::GovernorLimits limits = limits_of(options, (*opened)->capabilities(), kept);
    if (kept) kept->on_use();
    device::Rig rig{*std::move(opened), limits, mount};
    const std::string device = device::description(rig.device());
    if (options.device.is_real()) introduce(options, rig);
    const double allowed_n = rig.governor().limits().force_max_n;
    const bool is_asked_for = options.force_max_n != Options{}.force_max_n;
    const std::string lower = note_on_force_limit(options.force_max_n, allowed_n);
    if (is_asked_for && !lower.empty()) say(lower);
    const Settings settings = settings_of(options, rig);
    loop::Journal journal;
    monitor::Monitor monitor{journal, writer_for(options, device, rig, settings), options.id};
    std::optional<net::ResultFile> file;
    if (options.stats && *options.stats != "-") file.emplace(*options.stats);
    Side side{settings};
    loop::Watchdog watchdog{rig.device(), &crash};
    loop::Servo servo{{side, rig, socket, endpoints->remote, journal, watchdog}};

    std::optional<monitor::ControlSession> control_session;
    if (server) {
        control_session.emplace(monitor::ControlSession::Parts{
            *server, servo, options, journal, monitor, device, monitor::recovery_of(rig.device())});
    }

    loop::supervise({servo, monitor, stop, control_session ? &*control_session : nullptr},
                    ready_line(options, socket, endpoints->remote));

    if (kept) kept->on_rest(rig.governor().heat());
    const loop::ServoStatus status = servo.status();
    const monitor::Run run{options, status, journal, device, !monitor.record_failure()};
    write_statistics(run, file);
    return conclude(run, rig.governor(), monitor);
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

int main(int argc, char** argv)
{
    return hapnet::peer::main_program({argv, static_cast<std::size_t>(argc)});
}

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/rig.hpp"
#include "peer/chosen_device.hpp"
#include "peer/commands.hpp"
#include "peer/core/sync/text.hpp"
#include "peer/options.hpp"
#include "peer/report.hpp"
#include "peer/servo.hpp"
#include "peer/watcher.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/result_file.hpp"
#include "proto/net/stop_signal.hpp"
#include "proto/net/wait.hpp"

#include <array>
#include <cstdio>
#include <exception>
#include <memory>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <thread>

namespace hapnet::peer {

namespace {

constexpr std::string_view program = "hapnet-peer";
constexpr base::Duration drain_every{std::chrono::milliseconds{50}};

void say(std::string_view text) { net::say(program, text); }

struct Places {
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

base::Result<Places> look_up(const Options& options)
{
    const net::Endpoint listen = net::resolve(options.listen);
    const Places places{listen, resolve_remote(options.remote, listen)};
    if (places.listen.family() != places.remote.family()) {
        return base::fail(fmt::format(
            "--listen {} and --remote {} are of different families: give both as IPv4 or as IPv6",
            places.listen.to_text(), places.remote.to_text()));
    }
    if (!options.insecure && !(places.remote.is_loopback() && places.listen.is_loopback())) {
        return base::fail(
            "forces from a network need a key, and keys are not available yet: on a network you "
            "trust say --insecure, otherwise keep --listen and --remote on loopback");
    }
    net::require_route(places.remote);
    return places;
}

Settings settings_of(const Options& options)
{
    Settings settings;
    settings.introduction.id = options.id;
    settings.introduction.nonce = static_cast<std::uint32_t>(net::unpredictable_bits() | 1U);
    settings.introduction.scene_hash = scene::hash(options.scene);
    settings.introduction.seed = options.seed.value();
    settings.introduction.task = wire::TaskName::from_text(device::name_of(options.task)).value();
    settings.scene = options.scene;
    settings.algorithm = options.algorithm;
    settings.grip_damping_ns_per_m = options.grip_damping_ns_per_m;
    settings.length = options.duration;
    return settings;
}

std::optional<record::Writer> writer_for(const Options& options, std::string_view device)
{
    if (!options.record) return std::nullopt;
    return record::Writer{*options.record, configuration_json(options, device)};
}

std::string ready_line(const Options& options, const net::UdpSocket& socket,
                       const net::Endpoint& remote)
{
    return fmt::format("ready id={} listen={} remote={} task={} algorithm={} seed={}\n", options.id,
                       socket.local().to_text(), remote.to_text(), device::name_of(options.task),
                       name_of(options.algorithm), options.seed.value());
}

/// The servo on a thread of its own; an exception in it comes out of join().
class ServoThread {
public:
    explicit ServoThread(Servo& servo)
        : thread_{[this, &servo] {
              try {
                  servo.run();
              } catch (...) {
                  failure_ = std::current_exception();
                  failed_.store(true, std::memory_order_release);
              }
          }}
    {}

    [[nodiscard]] bool has_failed() const { return failed_.load(std::memory_order_acquire); }

    void join()
    {
        thread_.join();
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    std::exception_ptr failure_;
    std::atomic<bool> failed_{false};
    std::jthread thread_; // last: it uses the others
};

/// Watches the servo until it has ended; SIGINT and SIGTERM end it.
void watch(Servo& servo, Watcher& watcher, net::StopSignal& stop, const std::string& ready)
{
    ServoThread thread{servo};
    bool is_announced = false;
    try {
        while (!servo.is_done() && !thread.has_failed()) {
            const auto now = net::monotonic_now();
            const std::array descriptors{stop.descriptor()};
            // Once a stop is asked for, the descriptor may stay readable: then only sleep.
            net::wait_readable(stop.requested() ? std::span<const int>{} : descriptors,
                               now + drain_every);
            if (stop.requested()) servo.stop();
            if (!is_announced && servo.is_running()) {
                fmt::print("{}", ready);
                std::fflush(stdout);
                is_announced = true;
                if (const auto shortage = servo.real_time().shortage(); !shortage.empty()) {
                    say(shortage);
                }
            }
            watcher.drain();
            watcher.show(net::monotonic_now());
        }
    } catch (...) {
        servo.stop(); // such as a full disk: the hand comes first
        thread.join();
        throw;
    }
    thread.join();
    watcher.finish();
}

base::Result<int> run(const Options& options)
{
    const auto places = look_up(options);
    if (!places) return tl::unexpected{places.error()};
    net::StopSignal stop;
    net::UdpSocket socket{places->listen};
    auto opened = open_chosen(options.device, options.task);
    if (!opened) {
        say(fmt::format("--device {}: {}", options.device.name, opened.error().message));
        return net::exit_environment;
    }
    const device::Mount mount = mount_of(options.device, (*opened)->capabilities());
    device::Rig rig{*std::move(opened), device::GovernorLimits{}, mount};
    const std::string device = device::description(rig.device());
    if (options.device.is_real()) say(introduction(rig.device(), mount, options.task));
    Journal journal;
    Watcher watcher{journal, writer_for(options, device), options.id};
    std::optional<net::ResultFile> file;
    if (options.stats && *options.stats != "-") file.emplace(*options.stats);
    Peer peer{settings_of(options)};
    Servo servo{{peer, rig, socket, places->remote, journal, options.id}};

    watch(servo, watcher, stop, ready_line(options, socket, places->remote));

    const Run run{options, peer, servo, journal, socket, device};
    if (file) {
        file->commit(statistics_json(run));
    } else if (options.stats) {
        fmt::print("{}", statistics_json(run));
    }
    net::tell(summary(run));
    if (const auto reason = peer.refusal()) {
        say(fmt::format("refused: the other peer cannot play with this one: {}",
                        words_for(*reason)));
        return net::exit_failed;
    }
    return 0;
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

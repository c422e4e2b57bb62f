// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/e2e/recorded_peer.hpp"

#include "device/simulated/omni.hpp"
#include "peer/loop/supervise.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/program.hpp"
#include "proto/net/service_manager.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <limits>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace hapnet::e2e {

namespace {

using namespace std::chrono_literals;

constexpr int pushes_before_trouble = 200;

/// Deeper than any stack; the optimiser must not see through it.
// NOLINTNEXTLINE(misc-no-recursion)
int fall(volatile int* depth)
{
    volatile char room[4096] = {};
    room[0] = static_cast<char>(*depth);
    *depth = *depth + 1;
    return *depth < 0 ? 0 : fall(depth) + room[0];
}

/// Puts a full pipe there that has no reader.
void block(int descriptor)
{
    int ends[2] = {-1, -1};
    if (::pipe2(ends, O_NONBLOCK) != 0) std::abort(); // its reading end stays open
    const std::string text(4096, '.');
    while (write(ends[1], text.data(), text.size()) > 0) {}
    fcntl(ends[1], F_SETFL, 0);
    dup2(ends[1], descriptor);
}

/// Makes the terminal of this master the process's own, full and unread.
void take_over(int terminal)
{
    setsid();
    const int own = open(ptsname(terminal), O_RDWR); // the first that it opens controls it
    close(terminal);                                 // the test's alone is left
    if (own < 0) std::abort();
    fcntl(own, F_SETFL, O_NONBLOCK);
    const std::string text(4096, '.');
    while (write(own, text.data(), text.size()) > 0) {}
    fcntl(own, F_SETFL, 0);
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(own, descriptor);
}

class RecordingOmni final : public device::Device {
public:
    RecordingOmni(const RecordedPlay& play, int pipe)
        : play_{play}, pipe_{pipe}, capabilities_{omni_.capabilities()}
    {
        capabilities_.pacing = play.pacing;
    }
    [[nodiscard]] const device::Identity& identity() const override { return omni_.identity(); }
    [[nodiscard]] const device::Capabilities& capabilities() const override
    {
        return capabilities_;
    }
    void on_cue(const device::Cue& cue) override { omni_.on_cue(cue); }

    [[nodiscard]] device::Sample read(base::TimePoint now) override
    {
        device::Sample sample = omni_.read(now);
        if (pushes_ == pushes_before_trouble) trouble(sample);
        if (play_.needs_button) hold(sample);
        if (pushes_ == pushes_before_trouble && play_.trouble == Trouble::late_read && !hung_) {
            hang(60ms);
        }
        return sample;
    }
    void apply(const device::GovernedForce& force) override
    {
        const double newtons = base::norm(force.force());
        tell({.newtons = newtons, .motors_on = force.motors_on()});
        omni_.apply(force);
        if (newtons > 0.0) ++pushes_;
        if (pushes_ != pushes_before_trouble || hung_) return;
        if (play_.trouble == Trouble::hang) hang(60ms);
        if (play_.trouble == Trouble::long_hang) hang(200ms);
    }
    void halt() noexcept override
    {
        tell({.by_halt = true});
        omni_.halt();
    }
    void pace(const std::function<bool()>& beat) override
    {
        base::TimePoint due = net::monotonic_now();
        while (play_.trouble != Trouble::mute || pushes_ < pushes_before_trouble) {
            net::sleep_until(due += 1ms);
            if (!beat()) return;
        }
        hang(110ms); // as every device that waits in vain for a cycle
    }

private:
    void tell(Told told) const
    {
        told.at_ns = net::monotonic_now().time_since_epoch().count();
        std::ignore = write(pipe_, &told, sizeof told);
    }
    void hang(base::Duration duration)
    {
        hung_ = true;
        tell({.is_trouble = true});
        net::sleep_until(net::monotonic_now() + duration);
    }
    /// Holds the button, except for 20 ms in the middle of a push.
    void hold(device::Sample& sample)
    {
        const bool is_released = pushes_ >= pushes_before_trouble && released_ < 20;
        if (is_released && released_++ == 0) tell({.is_trouble = true});
        sample.buttons = is_released ? 0 : 2;
        sample.gripping = sample.gripping && !is_released;
    }
    void begin_trouble()
    {
        if (!is_troubled_) tell({.is_trouble = true});
        is_troubled_ = true;
    }
    void trouble(device::Sample& sample)
    {
        switch (play_.trouble) {
        case Trouble::none:
        case Trouble::hang:
        case Trouble::long_hang:
        case Trouble::late_read:
        case Trouble::mute: return;
        case Trouble::device_lost:
            begin_trouble();
            sample.fault = device::Fault::disconnected;
            return;
        case Trouble::nonsense:
            begin_trouble();
            sample.hip.value.y = std::numeric_limits<double>::quiet_NaN();
            return;
        case Trouble::docked:
            begin_trouble();
            sample.docked = true;
            return;
        case Trouble::exception:
            tell({.is_trouble = true});
            throw std::runtime_error{"the servo met what it cannot handle"};
        case Trouble::abort: tell({.is_trouble = true}); std::abort();
        case Trouble::exit: tell({.is_trouble = true}); std::exit(0);
        case Trouble::wild_write: {
            tell({.is_trouble = true});
            void* const page = mmap(nullptr, 4096, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
            *static_cast<volatile int*>(page) = 1; // nobody may write here
            return;
        }
        case Trouble::stack: {
            tell({.is_trouble = true});
            volatile int depth = 0;
            std::exit(fall(&depth));
        }
        }
    }

    RecordedPlay play_;
    int pipe_;
    device::SimulatedOmni omni_{{}};
    device::Capabilities capabilities_;
    int pushes_ = 0;
    bool hung_ = false;
    int released_ = 0; // ticks
    bool is_troubled_ = false;
};

/// Does the work of hapnet-peer, with this device.
base::Result<int> play(const std::pair<RecordedPlay, int>& options)
{
    const auto& [asked, pipe] = options;
    const net::StopSignal stop;
    net::ServiceManager manager;
    stop.enforce(800ms, net::exit_environment);
    net::TextQueue out{STDOUT_FILENO};
    net::TextQueue screen{STDERR_FILENO};
    const net::CrashSignal crash;
    const net::CrashStack stack;
    net::UdpSocket socket{net::resolve(net::parse_host_port(asked.listen).value())};
    device::Rig rig{std::make_unique<RecordingOmni>(asked, pipe), device::GovernorLimits{}};
    peer::loop::Journal journal;
    std::optional<record::Writer> writer;
    if (!asked.record.empty()) writer.emplace(asked.record, nlohmann::json::object());
    peer::monitor::Monitor monitor{journal, screen, {.writer = std::move(writer)}, {1}};
    peer::loop::ForceGate gate{stop, asked.needs_button
                                         ? peer::loop::DeadMan{peer::loop::DeviceButton{}}
                                         : peer::loop::DeadMan{}};
    peer::Settings settings;
    settings.introduction = {.id = 1,
                             .nonce = static_cast<std::uint32_t>(net::unpredictable_bits() | 1U),
                             .scene_hash = scene::hash(settings.scene),
                             .seed = 1,
                             .task = wire::TaskName::from_text("P1").value()};
    peer::Side side{settings};
    peer::loop::Watchdog watchdog{rig.device(), &crash};
    const net::Endpoint remote = net::resolve(net::parse_host_port(asked.remote).value());
    std::vector<peer::line::Line> to_remote;
    to_remote.emplace_back(remote.packed());
    peer::line::Lines lines{std::move(to_remote)};
    peer::loop::Servo servo{{side, rig, socket, {remote}, lines, journal, watchdog, gate}};
    const peer::Options unused;
    std::optional<control::Server> server;
    std::optional<peer::monitor::ControlSession> control_session;
    if (!asked.control.empty()) {
        server.emplace(asked.control, peer::monitor::ControlSession::limits);
        control_session.emplace(peer::monitor::ControlSession::Parts{*server, servo, stop, gate,
                                                                     unused, monitor, "recorded"});
    }
    peer::loop::supervise({servo, monitor, stop, gate, out, screen,
                           control_session ? &*control_session : nullptr, nullptr, &manager},
                          asked.blocked || asked.terminal >= 0 ? "ready\n" : "");
    peer::loop::wait_for_readers(screen, stop);
    return monitor.is_record_whole() ? 0 : net::exit_environment;
}

} // namespace

RecordedPeer::RecordedPeer(const RecordedPlay& asked)
{
    int ends[2] = {-1, -1};
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error{"pipe2"};
    std::fflush(stdout); // or the child would print it, too
    pid_ = fork();
    if (pid_ == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL); // should the test program be killed
        if (asked.terminal >= 0) {
            take_over(asked.terminal);
        } else if (asked.blocked) {
            block(STDOUT_FILENO);
            block(STDERR_FILENO);
        } else {
            dup2(open(asked.messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
        }
        const net::CommandLine<std::pair<RecordedPlay, int>> line{std::pair{asked, ends[1]}};
        // Without the exit handlers of this test program.
        _exit(net::run_program<std::pair<RecordedPlay, int>>("recorded peer", line, play));
    }
    close(ends[1]);
    pipe_ = ends[0];
}

RecordedPeer::~RecordedPeer()
{
    if (pid_ > 0) {
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
    }
    close(pipe_);
}

bool RecordedPeer::take_one()
{
    Told told;
    if (read(pipe_, &told, sizeof told) != static_cast<ssize_t>(sizeof told)) return false;
    told_.push_back(told);
    return true;
}

bool RecordedPeer::has_more(int wait_ms) const
{
    pollfd polled{pipe_, POLLIN, 0};
    return poll(&polled, 1, wait_ms) > 0;
}

bool RecordedPeer::pushes()
{
    // A peer that was late applies no force until its user acts.
    constexpr int patience = 10'000; // ticks
    int pushes = 0;
    for (int quiet = 0; pushes < pushes_before_trouble && quiet < patience && take_one(); ++quiet) {
        if (told_.back().newtons == 0.0) continue;
        ++pushes;
        quiet = 0;
    }
    return pushes == pushes_before_trouble;
}

void RecordedPeer::signal(int number) const { kill(pid_, number); }

void RecordedPeer::signal_thread(std::size_t thread, int number) const
{
    std::vector<pid_t> threads;
    const std::string tasks = "/proc/" + std::to_string(pid_) + "/task";
    for (const auto& entry : std::filesystem::directory_iterator{tasks}) {
        threads.push_back(std::stoi(entry.path().filename()));
    }
    // By birth: numbers begin again at the system's largest one.
    pid_t largest = 0;
    std::ifstream{"/proc/sys/kernel/pid_max"} >> largest;
    const auto age = [&](pid_t one) { return one >= pid_ ? one - pid_ : one - pid_ + largest; };
    std::sort(threads.begin(), threads.end(), [&](pid_t a, pid_t b) { return age(a) < age(b); });
    tgkill(pid_, threads.at(thread), number);
}

int RecordedPeer::wait_end()
{
    while (take_one()) {}
    int status = 0;
    waitpid(pid_, &status, 0);
    pid_ = -1;
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

} // namespace hapnet::e2e

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/commands.hpp"
#include "emulator/frame_session.hpp"
#include "emulator/scenario.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/interface.hpp"
#include "proto/net/own_network.hpp"
#include "proto/net/program.hpp"
#include "proto/net/stop_signal.hpp"

#include <chrono>
#include <csignal>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <vector>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;

/// One end of the wire, as its command sees it.
struct End {
    const char* wire; // the emulator's interface to it
    const char* address;
    const char* address_v6;
};
constexpr End end_a{"wire-a", "10.0.0.1", "fd00::1"};
constexpr End end_b{"wire-b", "10.0.0.2", "fd00::2"};
constexpr const char* end_interface = "eth0";

/// In the network of the command.
void prepare_end(const End& end)
{
    net::set_up("lo");
    net::switch_off_offloads(end_interface);
    net::set_up(end_interface);
    net::add_address(end_interface, end.address, 24);
    net::add_address(end_interface, end.address_v6, 64);
}

net::ChildCommand::Setup setup_of(const std::vector<std::string>& words, const End& end,
                                  bool has_terminal)
{
    return {.words = words,
            .has_own_network = true,
            .has_own_group = !has_terminal,
            .environment = {fmt::format("HAPNET_A={}", end_a.address),
                            fmt::format("HAPNET_B={}", end_b.address),
                            fmt::format("HAPNET_A6={}", end_a.address_v6),
                            fmt::format("HAPNET_B6={}", end_b.address_v6)},
            .hosts = fmt::format("{}\ta\n{}\tb\n{}\ta6\n{}\tb6\n", end_a.address, end_b.address,
                                 end_a.address_v6, end_b.address_v6),
            .prepare = [end] { prepare_end(end); }};
}

void connect(net::ChildCommand& child, const End& end)
{
    net::make_veth(end.wire, end_interface, child.pid());
    net::switch_off_offloads(end.wire);
    net::set_up(end.wire);
    child.prepare();
}

/// Both commands, from the start of B to the end of both.
class TwoCommands {
public:
    TwoCommands(net::ChildCommand& a, net::ChildCommand& b, FrameSession& session)
        : a_{a}, b_{b}, session_{session}
    {}

    /// Gives the exit code of A.
    int run(const net::StopSignal& stop)
    {
        start();
        while (!is_over()) {
            const auto now = session_.turn(descriptors(stop), next_look_);
            look_after(now, stop);
        }
        return a_.exit_code().value_or(128 + SIGKILL);
    }

private:
    /// B first; it goes on while A waits for it.
    void start()
    {
        b_.go();
        began_ = net::monotonic_now();
        next_look_ = began_;
    }

    [[nodiscard]] bool is_over() { return has_a_started_ && a_.exit_code() && b_.exit_code(); }

    /// Those whose end would be news.
    [[nodiscard]] std::vector<int> descriptors(const net::StopSignal& stop)
    {
        std::vector<int> all;
        if (!told_to_end_) all.push_back(stop.descriptor());
        if (has_a_started_ && !a_.exit_code()) all.push_back(a_.descriptor());
        if (!b_.exit_code()) all.push_back(b_.descriptor());
        return all;
    }

    void look_after(base::TimePoint now, const net::StopSignal& stop)
    {
        constexpr base::Duration patience = 1s; // of A, for B
        constexpr base::Duration pause = 10ms;
        if (!has_a_started_) {
            const bool is_ready = b_.exit_code() || net::has_listener(b_.pid());
            next_look_ = now + pause;
            if (!is_ready && now - began_ < patience && !stop.requested()) return;
            has_a_started_ = true;
            next_look_ = session_.end();
            a_.go();
        }
        if (!a_.exit_code() && b_.exit_code() && !told_to_end_ && !has_told_of_b_) {
            has_told_of_b_ = true;
            net::say("hapnet-emulator",
                     fmt::format("command B has ended with {}, before command A", *b_.exit_code()));
        }
        const bool is_time = a_.exit_code() || stop.requested() || session_.failure() ||
                             base::is_due(session_.end(), now);
        if (is_time) end_both(now);
    }

    void end_both(base::TimePoint now)
    {
        constexpr base::Duration grace = 3s;
        if (!told_to_end_) {
            told_to_end_ = now;
            a_.signal(SIGTERM);
            b_.signal(SIGTERM);
        } else if (now - *told_to_end_ >= grace) {
            a_.signal(SIGKILL);
            b_.signal(SIGKILL);
        }
        next_look_ = now + 20ms;
    }

    net::ChildCommand& a_;
    net::ChildCommand& b_;
    FrameSession& session_;
    base::TimePoint began_{};
    std::optional<base::TimePoint> next_look_;
    std::optional<base::TimePoint> told_to_end_;
    bool has_a_started_ = false;
    bool has_told_of_b_ = false;
};

} // namespace

base::Result<int> run(const BetweenOptions& options)
{
    const auto scenario = scenario_of(options.run);
    if (!scenario) return tl::unexpected{scenario.error()};
    const net::StopSignal stop{net::Hangup::stop};
    net::enter_own_network();
    net::ChildCommand a{setup_of(options.commands.first, end_a, /*has_terminal*/ true)};
    net::ChildCommand b{setup_of(options.commands.second, end_b, /*has_terminal*/ false)};
    connect(a, end_a);
    connect(b, end_b);
    FrameSession session{options.run,
                         *scenario,
                         {.command = "between",
                          .frames = {.interface_a = end_a.wire,
                                     .interface_b = end_b.wire,
                                     .all_frames = options.frames.all_frames,
                                     .fix_checksums = options.frames.fix_checksums}}};
    session.announce();
    const int code = TwoCommands{a, b, session}.run(stop);
    const bool is_complete = session.finish();
    return code == 0 && !is_complete ? net::exit_failed : code;
}

} // namespace hapnet::emulator

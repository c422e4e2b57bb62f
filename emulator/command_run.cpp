// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/command_run.hpp"

#include "proto/net/own_network.hpp"
#include "proto/net/program.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;

/// Returns the commands that start before A.
std::vector<net::CommandStart::Before> before_a(const std::vector<CommandRun::Other>& others)
{
    std::vector<net::CommandStart::Before> before;
    for (const CommandRun::Other& other : others) {
        if (other.runs_already) continue;
        before.push_back({.command = other.process, .is_ready = [pid = other.process.pid()] {
                              return net::has_listener(pid);
                          }});
    }
    return before;
}

} // namespace

CommandRun::CommandRun(net::ChildCommand& a, const std::vector<Other>& others,
                       FrameSession& session, const net::StopSignal& stop)
    : a_{a}, session_{session}, stop_{stop}, end_of_a_{a_}, start_{a_, before_a(others)}
{
    for (const Other& other : others) others_.push_back({other, Ending{other.process}});
}

int CommandRun::run()
{
    while (!is_over()) look_after(session_.turn(descriptors(), next_look_));
    return a_.exit_code().value_or(128 + SIGKILL);
}

/// True if a signal or a client of the control socket has asked the run to end.
bool CommandRun::is_told() const { return stop_.requested() || session_.is_stopped(); }

bool CommandRun::is_over()
{
    return has_a_started_ && end_of_a_.is_over() &&
           std::ranges::all_of(others_, [](Watched& one) { return one.end.is_over(); });
}

/// Returns the descriptors to watch: those of a stop, of the start, and of the ends of processes
/// that have not ended yet.
std::vector<int> CommandRun::descriptors()
{
    std::vector<int> all;
    if (!is_ending_) all.push_back(stop_.descriptor());
    if (!has_a_started_) all.push_back(start_.descriptor());
    if (has_a_started_ && !a_.exit_code()) all.push_back(a_.descriptor());
    for (Watched& one : others_) {
        if (!one.end.is_over()) all.push_back(one.other.process.descriptor());
    }
    return all;
}

void CommandRun::look_after(base::TimePoint now)
{
    if (!has_a_started()) return;
    if (!a_.exit_code() && !is_ending_) {
        for (Watched& one : others_) tell_of_ended(one);
    }
    is_ending_ = is_ending_ || a_.exit_code() || is_told() || session_.failure() ||
                 base::is_due(session_.end(), now);
    if (is_ending_) end_all(now);
}

void CommandRun::tell_of_ended(Watched& one)
{
    const auto code = one.other.process.exit_code();
    if (!code || std::exchange(one.has_told, true)) return;
    net::say("hapnet-emulator",
             fmt::format("{} has ended with {}, before command A", one.other.name, *code));
}

bool CommandRun::has_a_started()
{
    if (has_a_started_) return true;
    if (is_told()) start_.hurry();
    if (!start_.is_done()) return false;
    has_a_started_ = true;
    next_look_ = session_.end();
    return true;
}

/// Ends A first, because it may still have something to send to the others.
void CommandRun::end_all(base::TimePoint now)
{
    // A signal from the terminal also reaches A.
    const bool knows = stop_.requested() && stop_.came_to_group();
    if (!a_.exit_code()) {
        end_of_a_.pursue(knows ? 0 : stop_.number(), now);
    } else {
        // The interface to the process that serves the network disappears with that process.
        session_.expect_end();
        for (Watched& one : others_) one.end.pursue(SIGTERM, now);
    }
    next_look_ = now + 20ms;
}

void CommandRun::Ending::pursue(int number, base::TimePoint now)
{
    if (!told_) {
        told_ = now;
        if (number != 0) process_.signal(number);
    } else if (now - *told_ >= 3s) {
        process_.signal(SIGKILL);
    } else if (now - *told_ >= 2s && !std::exchange(is_told_again_, true)) {
        process_.signal(SIGTERM);
    }
}

} // namespace hapnet::emulator

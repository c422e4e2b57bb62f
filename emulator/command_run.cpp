// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/command_run.hpp"

#include "proto/net/own_network.hpp"
#include "proto/net/program.hpp"

#include <chrono>
#include <csignal>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::emulator {

namespace {

using namespace std::chrono_literals;

std::optional<net::CommandStart::Before> start_before_a(const CommandRun::Other& other)
{
    if (other.runs_already) return std::nullopt;
    return net::CommandStart::Before{
        .command = other.process,
        .is_ready = [pid = other.process.pid()] { return net::has_listener(pid); }};
}

} // namespace

CommandRun::CommandRun(net::ChildCommand& a, Other other, FrameSession& session,
                       const net::StopSignal& stop)
    : a_{a},
      other_{std::move(other)},
      session_{session},
      stop_{stop},
      end_of_a_{a_},
      end_of_other_{other_.process},
      start_{a_, start_before_a(other_)}
{}

int CommandRun::run()
{
    while (!is_over()) look_after(session_.turn(descriptors(), next_look_));
    return a_.exit_code().value_or(128 + SIGKILL);
}

/// Whether somebody wants it to end.
bool CommandRun::is_told() const { return stop_.requested() || session_.is_stopped(); }

bool CommandRun::is_over()
{
    return has_a_started_ && a_.exit_code() && other_.process.exit_code();
}

/// Those whose end would be news.
std::vector<int> CommandRun::descriptors()
{
    std::vector<int> all;
    if (!is_ending_) all.push_back(stop_.descriptor());
    if (!has_a_started_) all.push_back(start_.descriptor());
    if (has_a_started_ && !a_.exit_code()) all.push_back(a_.descriptor());
    if (!other_.process.exit_code()) all.push_back(other_.process.descriptor());
    return all;
}

void CommandRun::look_after(base::TimePoint now)
{
    if (!has_a_started()) return;
    const auto code = other_.process.exit_code();
    if (!a_.exit_code() && code && !is_ending_ && !std::exchange(has_told_of_other_, true)) {
        net::say("hapnet-emulator",
                 fmt::format("{} has ended with {}, before command A", other_.name, *code));
    }
    is_ending_ = is_ending_ || a_.exit_code() || is_told() || session_.failure() ||
                 base::is_due(session_.end(), now);
    if (is_ending_) end_both(now);
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

/// A first: it may still have something to say to the other one.
void CommandRun::end_both(base::TimePoint now)
{
    // What the terminal sends, it sends to A, too.
    const bool knows = stop_.requested() && stop_.came_to_group();
    if (!a_.exit_code()) {
        end_of_a_.pursue(knows ? 0 : stop_.number(), now);
    } else {
        session_.expect_end(); // the interface to a process that serves the network goes with it
        end_of_other_.pursue(SIGTERM, now);
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

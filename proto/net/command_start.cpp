// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/command_start.hpp"

#include "proto/net/clock.hpp"
#include "proto/net/real_time.hpp"

#include <fstream>
#include <poll.h>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace hapnet::net {

namespace {

/// True if a descriptor is readable, as a command's descriptor is once the command has ended.
/// Nothing is read, because the exit code of the command belongs to another thread.
bool is_readable(int descriptor)
{
    pollfd polled{descriptor, POLLIN, 0};
    return poll(&polled, 1, 0) > 0;
}

/// A command that the last one waits for.
struct Awaited {
    const CommandStart::Before* before;
    bool has_ended;
};

/// True if a command that has ended has left processes, which are now children of its init. Also
/// false if the kernel cannot tell.
bool has_left_processes(pid_t init)
{
    std::ifstream children{fmt::format("/proc/{0}/task/{0}/children", init)};
    std::string first;
    return static_cast<bool>(children >> first);
}

bool is_settled(Awaited& one)
{
    if (one.before->is_ready()) return true;
    const ChildCommand& command = one.before->command;
    one.has_ended = is_readable(command.descriptor());
    return one.has_ended && !has_left_processes(command.pid());
}

} // namespace

CommandStart::CommandStart(ChildCommand& last, std::vector<Before> before)
    : last_{last}, before_{std::move(before)}, thread_{[this] { run(); }}
{}

CommandStart::~CommandStart()
{
    is_over_.store(true);
    told_.signal();
    thread_.join();
}

void CommandStart::hurry()
{
    is_hurried_.store(true);
    told_.signal();
}

bool CommandStart::is_done() const
{
    if (!is_done_.load()) return false;
    if (failure_) std::rethrow_exception(failure_);
    return true;
}

void CommandStart::run() noexcept
{
    leave_real_time(); // the thread inherits the scheduling of the relay
    try {
        for (const Before& one : before_) one.command.go();
        if (awaits_last()) last_.go();
    } catch (...) {
        failure_ = std::current_exception();
    }
    is_done_.store(true);
    done_.signal();
}

/// Waits until the last command may start. Returns false if the start was cancelled.
bool CommandStart::awaits_last()
{
    constexpr int pause_ms = 10;
    const auto deadline = monotonic_now() + patience;
    std::vector<Awaited> awaited;
    for (const Before& one : before_) awaited.push_back({&one, false});
    std::vector<pollfd> polled;
    while (true) {
        std::erase_if(awaited, is_settled);
        const bool is_told = is_over_.load() || is_hurried_.load();
        if (awaited.empty() || is_told || monotonic_now() >= deadline) return !is_over_.load();
        polled.assign(1, {told_.descriptor(), POLLIN, 0});
        for (const Awaited& one : awaited) {
            if (!one.has_ended) polled.push_back({one.before->command.descriptor(), POLLIN, 0});
        }
        std::ignore = poll(polled.data(), polled.size(), pause_ms);
    }
}

} // namespace hapnet::net

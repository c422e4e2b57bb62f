// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/command_start.hpp"

#include "proto/net/clock.hpp"
#include "proto/net/real_time.hpp"

#include <array>
#include <poll.h>
#include <tuple>
#include <utility>

namespace hapnet::net {

CommandStart::CommandStart(ChildCommand& last, std::optional<Before> before)
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
    leave_real_time(); // the scheduling of the relay is inherited
    try {
        if (before_) before_->command.go();
        if (!before_ || awaits_last()) last_.go();
    } catch (...) {
        failure_ = std::current_exception();
    }
    is_done_.store(true);
    done_.signal();
}

/// Waits until the last command may start. False when nobody wants it any more.
bool CommandStart::awaits_last()
{
    constexpr int pause_ms = 10;
    const auto deadline = monotonic_now() + before_->patience;
    // The first is readable once the command has ended, which nothing but poll() asks here: its
    // exit code belongs to another thread.
    std::array<pollfd, 2> polled{
        {{before_->command.descriptor(), POLLIN, 0}, {told_.descriptor(), POLLIN, 0}}};
    const auto has_ended = [&] { return polled[0].revents != 0; };
    while (!is_over_.load() && !is_hurried_.load() && !has_ended() && monotonic_now() < deadline &&
           !before_->is_ready()) {
        std::ignore = poll(polled.data(), polled.size(), pause_ms);
    }
    return !is_over_.load();
}

} // namespace hapnet::net

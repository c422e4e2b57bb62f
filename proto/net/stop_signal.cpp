// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/stop_signal.hpp"

#include <cerrno>
#include <csignal>
#include <sys/signalfd.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace hapnet::net {

StopSignal::StopSignal(Hangup hangup) : hangup_{hangup}
{
    std::signal(SIGPIPE, SIG_IGN);
    sigset_t signals{};
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    sigaddset(&signals, SIGHUP);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    descriptor_ = signalfd(-1, &signals, SFD_NONBLOCK | SFD_CLOEXEC);
    if (descriptor_ < 0) throw std::system_error{errno, std::generic_category(), "signalfd"};
}

StopSignal::~StopSignal() { close(descriptor_); }

bool StopSignal::requested()
{
    take();
    return requested_;
}

bool StopSignal::reload_requested()
{
    take();
    return std::exchange(reload_requested_, false);
}

void StopSignal::take()
{
    signalfd_siginfo info{};
    while (read(descriptor_, &info, sizeof info) == static_cast<ssize_t>(sizeof info)) {
        const bool is_hangup = info.ssi_signo == static_cast<std::uint32_t>(SIGHUP);
        (is_hangup && hangup_ == Hangup::reload ? reload_requested_ : requested_) = true;
    }
}

} // namespace hapnet::net

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"

namespace hapnet::bench {

/// How a baseline waits for the next departure.
enum class Waiting : std::uint8_t {
    poll,    // poll() with whole milliseconds, rounded up, so that nothing leaves early
    timerfd, // epoll and a timerfd at the exact time
};

struct BaselineOptions {
    Waiting waiting = Waiting::poll;
    net::Endpoint a; // where what comes from B goes
    net::Endpoint b;
    base::Duration delay{};
};

/// A relay with a constant delay, written as the tools of the field are written, with care: one
/// thread, non-blocking sockets with 4 MB buffers, a heap of what is under way, one recv and one
/// send per datagram, the delay counted from when recv returned. Never returns.
[[noreturn]] void run_baseline(const BaselineOptions& options);

} // namespace hapnet::bench

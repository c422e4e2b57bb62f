// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"

namespace hapnet::bench {

/// The way in which a baseline waits for the next departure.
enum class Waiting : std::uint8_t {
    poll,    // poll() with whole milliseconds, rounded up, so that nothing leaves early
    timerfd, // epoll and a timerfd at the exact time
};

struct BaselineOptions {
    Waiting waiting = Waiting::poll;
    net::Endpoint a; // receiver of datagrams from B
    net::Endpoint b;
    base::Duration delay{};
};

/// A relay with a constant delay, written with care in the way of common tools: one thread,
/// non-blocking sockets with 4 MB buffers, a heap of delayed datagrams, one recv and one send per
/// datagram. The delay counts from the return of recv. Never returns.
[[noreturn]] void run_baseline(const BaselineOptions& options);

} // namespace hapnet::bench

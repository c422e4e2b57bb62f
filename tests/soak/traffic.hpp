// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/udp_socket.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <sys/types.h>
#include <thread>

namespace hapnet::soak {

/// The whole number in an environment variable, or `usual` when it is not set. Throws
/// std::invalid_argument when it is no number.
[[nodiscard]] std::int64_t setting(const char* name, std::int64_t usual);

/// What a running program has of memory, in KiB.
struct Memory {
    std::int64_t resident = 0; // VmRSS
    std::int64_t data = 0;     // VmData: heap, stacks and other private memory, used or not
};
/// Throws std::runtime_error when there is no such program.
[[nodiscard]] Memory memory_of(pid_t pid);

/// Both ends of an emulator, on a thread of its own: every millisecond each end sends a share of
/// the rate to the emulator, A one by one and B merged where the kernel can (UDP_SEGMENT), and
/// reads away what has come. Of 100 datagrams 90 hold 100 bytes, 9 hold 1000, and one 1500.
///
/// The first second is four times as fast: the emulator takes all memory at its start, but the
/// system gives it only when it is used, and what a later pause of the sender leaves behind (made
/// up for at twice the rate) shall not use more of it than was used then.
class Traffic {
public:
    Traffic();
    ~Traffic();
    Traffic(const Traffic&) = delete;
    Traffic& operator=(const Traffic&) = delete;

    [[nodiscard]] net::Endpoint a() const { return a_.local(); }
    [[nodiscard]] net::Endpoint b() const { return b_.local(); }

    /// Begins to send so many datagrams a second each way, to where the emulator listens.
    void start(std::int64_t per_second, const net::Endpoint& for_a, const net::Endpoint& for_b);
    /// Ends when what is in the emulator has had the time to leave it.
    void stop();

    /// What the kernel has taken for the emulator: of A and B together.
    [[nodiscard]] std::uint64_t sent() const { return sent_.load(std::memory_order_relaxed); }

private:
    struct Target {
        std::int64_t per_second = 0;
        net::Endpoint for_a;
        net::Endpoint for_b;
    };

    void run(const Target& target);
    void send(const Target& target, std::uint64_t count);
    void drain();

    net::UdpSocket a_;
    net::UdpSocket b_;
    std::atomic<std::uint64_t> sent_{0};
    std::atomic<bool> stop_{false};
    std::uint64_t number_ = 0; // of the next datagram of each end
    std::thread thread_;
};

} // namespace hapnet::soak

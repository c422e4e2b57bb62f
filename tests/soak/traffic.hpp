// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/udp_socket.hpp"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <sys/types.h>
#include <thread>
#include <vector>

namespace hapnet::soak {

/// The whole number in an environment variable, or `usual` when it is not set. Throws
/// std::invalid_argument when it is no number.
[[nodiscard]] std::int64_t setting(const char* name, std::int64_t usual);

/// The memory of a running program, KiB.
struct Memory {
    std::int64_t resident = 0; // VmRSS
    std::int64_t data = 0;     // VmData: heap, stacks and other private memory, used or not
};
/// Throws std::runtime_error when there is no such program.
[[nodiscard]] Memory memory_of(pid_t pid);

/// A line of a soak's output.
[[nodiscard]] std::string line(std::int64_t seconds, const Memory& memory);

/// Expects that nothing grows after the first minute, or fifth when that is shorter: by then each
/// change was made and the queues have been as long as they become. `memory`: at the end of each
/// second.
void expect_flat(const std::vector<Memory>& memory);

/// Both ends of an emulator, on a thread of its own: every millisecond each end sends a share of
/// the rate to the emulator, A one by one and B merged where the kernel can (UDP_SEGMENT), and
/// reads away what has come. A may be many senders. Of 100 datagrams 90 hold 100 bytes, 9 hold
/// 1000, and one 1500.
///
/// The first second is four times as fast: the emulator takes all memory at its start, but the
/// system gives it only when it is used, and what a later pause of the sender leaves behind (made
/// up for at twice the rate) shall not use more of it than was used then.
class Traffic {
public:
    explicit Traffic(std::size_t senders = 1);
    ~Traffic();
    Traffic(const Traffic&) = delete;
    Traffic& operator=(const Traffic&) = delete;

    /// The first sender's.
    [[nodiscard]] net::Endpoint a() const { return a_.front()->local(); }
    [[nodiscard]] net::Endpoint b() const { return b_.local(); }

    /// Begins to send this many datagrams a second each way, to the emulator's places in turn. B
    /// sends to all that it hears from if there are no places for it.
    void start(std::int64_t per_second, std::vector<net::Endpoint> for_a,
               std::vector<net::Endpoint> for_b);
    /// Ends once the emulator has had time to send all datagrams.
    void stop();

    /// Datagrams that the kernel took for the emulator, from A and B together.
    [[nodiscard]] std::uint64_t sent() const { return sent_.load(std::memory_order_relaxed); }

private:
    struct Target {
        std::int64_t per_second = 0;
        std::vector<net::Endpoint> for_a;
        std::vector<net::Endpoint> for_b;
        bool answers = false;
    };

    void run(Target target);
    void send(const Target& target, std::uint64_t count);
    void drain(Target& target);

    std::vector<std::unique_ptr<net::UdpSocket>> a_;
    net::UdpSocket b_;
    std::atomic<std::uint64_t> sent_{0};
    std::atomic<bool> stop_{false};
    std::uint64_t number_ = 0;  // of the next datagram of each end
    std::uint64_t batches_ = 0; // of B
    std::thread thread_;
};

} // namespace hapnet::soak

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/udp_socket.hpp"
#include "tests/bench/emulator/lateness.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hapnet::bench {

constexpr std::size_t payload_bytes = 100;

/// The sender's way to pass datagrams to the kernel: one by one (in one system call), or merged by
/// UDP_SEGMENT. The receiver takes them in the same way.
enum class Sending : std::uint8_t { ordinary, offload };

/// The datagrams that came back from a path.
struct Tally {
    std::uint64_t sent = 0;
    std::uint64_t received = 0;
    std::uint64_t reordered = 0; // came after one that was sent later
    /// Returns the share of the sent datagrams that has not come yet.
    [[nodiscard]] double missing() const;
};

struct TimingTrial {
    /// The sorted errors: kernel receive stamp - time before the send call - the delay.
    std::vector<base::Duration> errors;
    /// The sorted errors of datagrams for which the relay had another datagram to receive in the
    /// last `shortly` before they were due.
    std::vector<base::Duration> errors_beside_arrival;
    /// The departures of datagrams whose send call returned at once. If the prober itself was
    /// stopped in that call, the lateness says nothing about the relay.
    std::vector<Departure> departures;
    Tally tally;
    static constexpr base::Duration shortly = std::chrono::microseconds{200};
};

struct RateTrial {
    Tally tally;
    double rate = 0.0; // datagrams per second, as they were sent
    /// The share that was lost, or still queued 10 ms after the last was due. A rate that only fits
    /// into the buffers during a trial is not kept up.
    double missing = 0.0;
};

/// Both ends of the path that is measured, on one thread: sends numbered and stamped datagrams,
/// and receives them with kernel stamps.
class Prober {
public:
    explicit Prober(Sending sending);

    /// The ends A and B; a relay sends to B what A sent to it.
    [[nodiscard]] net::Endpoint a() const { return a_.local(); }
    [[nodiscard]] net::Endpoint b() const { return b_.local(); }

    struct Load {
        net::Endpoint to;
        double rate = 1000.0;      // datagrams per second
        base::Duration duration{}; // of sending
        base::Duration delay{};    // of the path
    };

    /// Sends single datagrams. The times between them are uniform on 0.5 to 1.5 of the mean: with
    /// equal times, departures would meet arrivals at the same phase again and again.
    TimingTrial measure_timing(const Load& load);

    /// Bursts of 64, back to back when the rate is above what this thread can send. An ordinary
    /// receiver would take more of this processor than the sender: with Sending::ordinary the
    /// kernel counts what arrives at an ordinary socket and drops it, after all of the path's work.
    RateTrial measure_rate(const Load& load);

private:
    struct Note {
        std::uint64_t number = 0;
        base::TimePoint sent_at{};
    };

    [[nodiscard]] bool has_sent_shortly_before(base::TimePoint due) const;
    [[nodiscard]] std::vector<Departure> departures(base::Duration delay) const;
    void send_burst(const net::Endpoint& to);
    void receive(const Load& load);
    void make_sink();
    void receive_rest(const Load& load);
    void receive_until(const Load& load, base::TimePoint end);
    void begin();

    Sending sending_;
    net::UdpSocket a_;
    net::UdpSocket b_;
    std::vector<std::byte> burst_;
    std::uint64_t next_number_ = 0; // never used twice: what a trial left behind is not counted
    std::uint64_t first_number_ = 0;
    std::uint64_t highest_ = 0;
    std::uint64_t overflowed_ = 0;
    bool is_sink_ = false;
    std::uint32_t sunk_ = 0; // as the kernel counts them: 32 bits, wrapping
    Tally tally_;
    std::vector<base::TimePoint> sent_at_; // of the trial's datagrams
    std::vector<base::TimePoint> stopped_; // times at which the prober was stopped
    std::vector<base::Duration> errors_;
    std::vector<base::TimePoint> due_; // of those in errors_
};

} // namespace hapnet::bench

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// A steady stream of 1 kHz, and a second of flood from the same sender beside it.
#include "proto/base/bytes.hpp"
#include "proto/net/batch_sender.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/udp_socket.hpp"
#include "proto/net/wait.hpp"
#include "tests/e2e/emulator.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <optional>
#include <set>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <tuple>
#include <vector>

namespace hapnet::soak {

namespace {

using namespace std::chrono_literals;
using Microseconds = std::chrono::duration<double, std::micro>;

constexpr std::size_t steady_bytes = 100; // and the flood's datagrams have another size

/// The steady stream is sent for 2 s, 1 s beside the flood, 0.1 s in which lateness may still be
/// anything, and 2 s in which it has to be as before.
constexpr base::Duration flood_begin = 2s;
constexpr base::Duration flood_end = 3s;
constexpr base::Duration recovered = flood_end + 100ms;
constexpr base::Duration stream_end = recovered + 2s;

struct Flood {
    std::vector<std::string> conditions;
    base::Duration delay{};
    std::size_t bytes = 0;
    std::int64_t per_second = 0;
};

/// A steady datagram that has come.
struct Steady {
    base::Duration sent{}; // since the beginning
    base::Duration late{}; // beyond the delay
};

void keep_only_steady(int descriptor)
{
    // The kernel gives a filter of a UDP socket the UDP header and what follows.
    const auto length = static_cast<std::uint32_t>(steady_bytes + 8);
    std::array<sock_filter, 4> code{{{BPF_LD | BPF_H | BPF_ABS, 0, 0, 4},
                                     {BPF_JMP | BPF_JEQ | BPF_K, 0, 1, length},
                                     {BPF_RET | BPF_K, 0, 0, 0xffff},
                                     {BPF_RET | BPF_K, 0, 0, 0}}};
    const sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
    ASSERT_EQ(setsockopt(descriptor, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof program), 0);
}

class Trial {
public:
    explicit Trial(const Flood& flood) : flood_{flood}, a_{any_port()}, b_{any_port()}
    {
        keep_only_steady(b_.descriptor());
        std::vector<std::string> options{"--a", a_.local().to_text(), "--b", b_.local().to_text()};
        options.insert(options.end(), flood.conditions.begin(), flood.conditions.end());
        emulator_.emplace(options);
    }

    void run()
    {
        start_ = net::monotonic_now();
        std::thread receiver{[this] { receive(); }};
        std::thread flood{[this] { send_flood(); }};
        send_steady();
        flood.join();
        receiver.join();
        statistics_ = emulator_->stop()["up"]; // expects the identity
        print();
    }

    /// Some datagrams were dropped, and counted. When the kernel drops merged datagrams before they
    /// are received (`overflowed`), it counts them as one.
    void expect_drops() const
    {
        const auto overflowed = statistics_["overflowed"].get<std::uint64_t>();
        EXPECT_GT(dropped() + overflowed, 0U);
        EXPECT_LE(received() + overflowed, flooded_ + steady_);
        EXPECT_GE(received() + net::BatchSender::batch_max * overflowed, flooded_ + steady_);
    }

    /// Expects that every drop was counted separately.
    void expect_all_counted() const
    {
        expect_drops();
        EXPECT_EQ(received(), flooded_ + steady_);
    }

    /// p50 at most twice that before the flood, or 0.2 ms; p99 at most twice, or 1 ms: the effect
    /// of a shared or virtual machine's scheduler on 2000 datagrams. None is missing.
    void expect_normal_lateness_again() const
    {
        const auto before = lateness(0ms, flood_begin);
        const auto after = lateness(recovered, stream_end);
        ASSERT_EQ(before.size(), 2000U);
        ASSERT_EQ(after.size(), 2000U);
        EXPECT_LE(quantile(after, 0.5).count(),
                  std::max(2.0 * quantile(before, 0.5).count(), 200.0));
        EXPECT_LE(quantile(after, 0.99).count(),
                  std::max(2.0 * quantile(before, 0.99).count(), 1000.0));
    }

private:
    static net::Endpoint any_port() { return net::resolve({"127.0.0.1", 0}); }

    [[nodiscard]] std::uint64_t received() const
    {
        return statistics_["received"].get<std::uint64_t>();
    }

    [[nodiscard]] std::uint64_t dropped() const
    {
        std::uint64_t sum = 0;
        for (const auto& count : statistics_["dropped"]) sum += count.get<std::uint64_t>();
        return sum;
    }

    void send_steady()
    {
        for (auto at = base::Duration{0}; at < stream_end; at += 1ms) {
            net::sleep_until(start_ + at);
            std::array<std::byte, steady_bytes> datagram{};
            base::ByteWriter out{datagram};
            out.i64(at.count());
            out.i64(net::monotonic_now().time_since_epoch().count());
            if (net::send_one(a_.descriptor(), emulator_->a(), datagram) ==
                net::SendOutcome::sent) {
                ++steady_;
            }
        }
    }

    /// In batches that the kernel may merge, so that one core can send several times what the
    /// emulator can take.
    void send_flood()
    {
        const std::vector<std::byte> datagram(flood_.bytes);
        const std::vector<std::span<const std::byte>> batch(net::BatchSender::batch_max, datagram);
        net::BatchSender sender;
        const auto begin = start_ + flood_begin;
        net::sleep_until(begin);
        for (auto now = begin; now < start_ + flood_end; now = net::monotonic_now()) {
            const auto due = (now - begin) / 1us * flood_.per_second / 1'000'000;
            if (static_cast<std::int64_t>(flooded_) > due) {
                net::sleep_until(now + 200us);
                continue;
            }
            const auto outcomes = sender.send(a_.descriptor(), emulator_->a(), batch);
            flooded_ += static_cast<std::uint64_t>(
                std::count(outcomes.begin(), outcomes.end(), net::SendOutcome::sent));
        }
    }

    void receive()
    {
        const auto end = start_ + stream_end + flood_.delay + 500ms;
        while (net::monotonic_now() < end) {
            net::wait_readable(std::array{b_.descriptor()}, end);
            for (const net::Received& datagram : b_.receive()) {
                base::ByteReader in{datagram.bytes};
                const base::Duration at{in.i64()};
                const base::TimePoint sent{base::Duration{in.i64()}};
                // The first arrival of a copied datagram counts. The copy is sent later.
                if (seen_.insert(at).second) {
                    arrived_.push_back({at, datagram.at - sent - flood_.delay});
                }
            }
        }
    }

    [[nodiscard]] std::vector<base::Duration> lateness(base::Duration from, base::Duration to) const
    {
        std::vector<base::Duration> late;
        for (const Steady& steady : arrived_) {
            if (steady.sent >= from && steady.sent < to) late.push_back(steady.late);
        }
        std::sort(late.begin(), late.end());
        return late;
    }

    static Microseconds quantile(const std::vector<base::Duration>& sorted, double share)
    {
        return sorted.at(static_cast<std::size_t>(share * static_cast<double>(sorted.size())));
    }

    void print() const
    {
        const auto left = received() - dropped(); // without copies
        fmt::print("  flood: {} sent in 1 s, {:.2f} times what left; {} received with the steady "
                   "stream, {} left, {} delivered, {} dropped, {} overflowed\n",
                   flooded_, static_cast<double>(flooded_) / static_cast<double>(left), received(),
                   left, statistics_["delivered"].dump(), dropped(),
                   statistics_["overflowed"].dump());
        const auto say = [this](const char* when, base::Duration from, base::Duration to) {
            const auto late = lateness(from, to);
            if (late.empty()) return fmt::print("  {}: none came\n", when);
            fmt::print("  {}: {} came, late by p50 {:.0f} us, p99 {:.0f} us, max {:.0f} us\n", when,
                       late.size(), quantile(late, 0.5).count(), quantile(late, 0.99).count(),
                       Microseconds{late.back()}.count());
        };
        say("before", 0ms, flood_begin);
        say("beside", flood_begin, flood_end);
        say("to 100 ms after", flood_end, recovered);
        say("after", recovered, stream_end);
    }

    Flood flood_;
    net::UdpSocket a_;
    net::UdpSocket b_;
    std::optional<e2e::Emulator> emulator_;
    base::TimePoint start_;
    std::uint64_t steady_ = 0;
    std::uint64_t flooded_ = 0;
    std::vector<Steady> arrived_;
    std::set<base::Duration> seen_;
    nlohmann::json statistics_;
};

} // namespace

/// 1000 B with their headers at 50 Mbit/s are 6250 a second.
TEST(Flood, OfThreeTimesTheRateOfTheLink)
{
    Trial trial{{{"--delay", "20ms", "--rate", "50Mbit/s"}, 20ms, 972, 3 * 6250}};
    trial.run();
    trial.expect_all_counted();
    trial.expect_normal_lateness_again();
}

/// 16 384 datagrams of more than 256 B have room at a time: with 200 ms of delay 81 920 a second.
TEST(Flood, OfThreeTimesWhatTheMemoryHolds)
{
    Trial trial{{{"--delay", "200ms"}, 200ms, 1000, 3 * 81'920}};
    trial.run();
    trial.expect_all_counted();
    trial.expect_normal_lateness_again();
}

/// As fast as the sender can, while the emulator has to send each datagram twice.
TEST(Flood, OfThreeTimesWhatTheProcessorCanRelay)
{
    Trial trial{{{"--delay", "20ms", "--duplicate", "100%"}, 20ms, 120, 100'000'000}};
    trial.run();
    trial.expect_drops();
    trial.expect_normal_lateness_again();
}

} // namespace hapnet::soak

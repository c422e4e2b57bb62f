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
    std::int64_t per_second = 0; // 0: as fast as it can, merged by UDP_SEGMENT
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

    /// Everything that was sent was received or is counted, and much of it was not delivered.
    /// `exactly`: the kernel counts merged datagrams that it drops as one.
    void expect_counted_drops(bool exactly) const
    {
        const auto sent = flooded_ + steady_;
        const auto seen = statistics_["received"].get<std::uint64_t>() +
                          statistics_["overflowed"].get<std::uint64_t>();
        EXPECT_LE(seen, sent);
        if (exactly) {
            EXPECT_EQ(seen, sent);
        }
        EXPECT_LT(statistics_["delivered"].get<std::uint64_t>(), sent);
        EXPECT_GT(statistics_["overflowed"].get<std::uint64_t>() + dropped(), 0U);
    }

    /// p50 at most twice that before the flood, or 0.2 ms; p99 at most twice, or 1 ms: what the
    /// scheduler of a shared or virtual machine does to 2000 datagrams. None is missing.
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

    [[nodiscard]] std::uint64_t flooded() const { return flooded_; }
    [[nodiscard]] std::uint64_t delivered() const
    {
        return statistics_["delivered"].get<std::uint64_t>();
    }

private:
    static net::Endpoint any_port() { return net::resolve({"127.0.0.1", 0}); }

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

    void send_flood()
    {
        const std::vector<std::byte> datagram(flood_.bytes);
        const std::vector<std::span<const std::byte>> batch(net::BatchSender::batch_max, datagram);
        net::BatchSender sender;
        net::sleep_until(start_ + flood_begin);
        for (auto now = start_ + flood_begin; now < start_ + flood_end;
             now = net::monotonic_now()) {
            if (flood_.per_second == 0) {
                const auto outcomes = sender.send(a_.descriptor(), emulator_->a(), batch);
                flooded_ += static_cast<std::uint64_t>(
                    std::count(outcomes.begin(), outcomes.end(), net::SendOutcome::sent));
                continue;
            }
            const auto due = (now - start_ - flood_begin) / 1us * flood_.per_second / 1'000'000;
            while (static_cast<std::int64_t>(flooded_) < due) {
                if (net::send_one(a_.descriptor(), emulator_->a(), datagram) ==
                    net::SendOutcome::sent) {
                    ++flooded_;
                }
            }
            net::sleep_until(now + 1ms);
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
                arrived_.push_back({at, datagram.at - sent - flood_.delay});
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
        fmt::print("  flood: {} sent in 1 s; with the steady stream {} received, {} delivered, {} "
                   "overflowed, dropped {}\n",
                   flooded_, statistics_["received"].dump(), delivered(),
                   statistics_["overflowed"].dump(), statistics_["dropped"].dump());
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
    nlohmann::json statistics_;
};

} // namespace

/// 1000 B with their headers at 50 Mbit/s are 6250 a second.
TEST(Flood, OfThreeTimesTheRateOfTheLink)
{
    Trial trial{{{"--delay", "20ms", "--rate", "50Mbit/s"}, 20ms, 972, 3 * 6250}};
    trial.run();
    trial.expect_counted_drops(true);
    trial.expect_normal_lateness_again();
}

/// 16 384 datagrams of more than 256 B have room at a time: with 200 ms of delay 81 920 a second.
TEST(Flood, OfThreeTimesWhatTheMemoryHolds)
{
    Trial trial{{{"--delay", "200ms"}, 200ms, 1000, 3 * 81'920}};
    trial.run();
    trial.expect_counted_drops(true);
    trial.expect_normal_lateness_again();
}

/// More than the emulator can take, as far as one core of this machine can send it.
TEST(Flood, AsFastAsTheSenderCan)
{
    Trial trial{{{"--delay", "20ms"}, 20ms, 120, 0}};
    trial.run();
    trial.expect_counted_drops(false);
    trial.expect_normal_lateness_again();
    fmt::print("  sent {:.2f} times what was delivered\n",
               static_cast<double>(trial.flooded()) / static_cast<double>(trial.delivered()));
}

} // namespace hapnet::soak

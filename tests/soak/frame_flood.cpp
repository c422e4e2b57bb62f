// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// frame_flood NAME HOST PER_SECOND SECONDS: one end of a wire. Sends PER_SECOND datagrams to port
// 7002 of the host, or, for 0, as many as it can, and reads those that arrive. Then prints "NAME
// sent N", and stays until a signal or for 2 s more.
#include "proto/net/clock.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/udp_socket.hpp"
#include "proto/net/wait.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <vector>

namespace hapnet::soak {

namespace {

using namespace std::chrono_literals;

constexpr std::uint16_t port = 7002;
constexpr std::size_t batch = 32;

/// Of 100 datagrams 90 hold 100 bytes, 9 hold 1000, and one 1472, which fills the MTU.
std::size_t bytes_of(std::uint64_t number)
{
    const auto kind = number % 100;
    return kind < 90 ? 100 : kind < 99 ? 1000 : 1472;
}

class End {
public:
    explicit End(const std::string& host)
        : socket_{net::resolve({"0.0.0.0", port})}, to_{net::resolve({host, port})}
    {}

    void send_until(base::TimePoint end, std::int64_t per_second)
    {
        const auto begin = net::monotonic_now();
        for (auto now = begin; now < end; now = net::monotonic_now()) {
            read();
            const auto due = (now - begin) / 1us * per_second / 1'000'000;
            if (per_second > 0 && static_cast<std::int64_t>(sent_) >= due) {
                net::sleep_until(now + 1ms);
                continue;
            }
            send();
        }
    }

    void read_until(base::TimePoint end)
    {
        for (auto now = net::monotonic_now(); now < end; now = net::monotonic_now()) {
            net::wait_readable(std::array{socket_.descriptor()}, end);
            read();
        }
    }

    [[nodiscard]] std::uint64_t sent() const { return sent_; }

private:
    void read()
    {
        for (int i = 0; i < 8 && !socket_.receive().empty(); ++i) continue;
    }

    void send()
    {
        std::array<std::span<const std::byte>, batch> datagrams;
        for (auto& datagram : datagrams) {
            datagram = std::span<const std::byte>{bytes_}.first(bytes_of(number_++));
        }
        const auto outcomes = socket_.send_batch(to_, datagrams);
        sent_ += static_cast<std::uint64_t>(
            std::count(outcomes.begin(), outcomes.end(), net::SendOutcome::sent));
    }

    net::UdpSocket socket_;
    net::Endpoint to_;
    std::array<std::byte, 1472> bytes_{};
    std::uint64_t number_ = 0;
    std::uint64_t sent_ = 0;
};

} // namespace

int flood(const std::vector<std::string>& words)
{
    const std::chrono::seconds length{std::stoll(words.at(3))};
    End end{words.at(1)};
    const auto until = net::monotonic_now() + length;
    end.send_until(until, std::stoll(words.at(2)));
    fmt::print("{} sent {}\n", words.at(0), end.sent());
    std::fflush(stdout);
    end.read_until(until + 2s);
    return 0;
}

} // namespace hapnet::soak

int main(int count, char** words)
{
    if (count == 5) return hapnet::soak::flood({words + 1, words + count});
    fmt::print(stderr, "usage: frame_flood NAME HOST PER_SECOND SECONDS\n");
    return 2;
}

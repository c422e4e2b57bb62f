// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A sender that sets the ECN bits of what it sends, and a receiver that reads those of what arrives
// and tells them back:
//   marks_host tell PORT
//   marks_host send HOST:PORT CLASS COUNT    prints how many arrived with each ECN codepoint
// The sender first knocks with empty datagrams that are not ECN-capable, until one is answered: the
// receiver may begin later.
#include "proto/net/clock.hpp"
#include "proto/net/udp_socket.hpp"
#include "proto/net/wait.hpp"

#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <netinet/in.h>
#include <span>
#include <string>
#include <sys/socket.h>
#include <tuple>

namespace {

using namespace hapnet;
using namespace std::chrono_literals;

[[noreturn]] void tell(const std::string& port)
{
    net::UdpSocket socket{net::resolve(*net::parse_host_port("0.0.0.0:" + port)), net::Load::bulk};
    while (true) {
        net::wait_readable(std::array{socket.descriptor()}, std::nullopt);
        for (const net::Received& one : socket.receive()) {
            const std::array answer{std::byte{one.marks.traffic_class}};
            const std::span told{answer};
            std::ignore = socket.send(one.from, one.bytes.empty() ? told.first(0) : told);
        }
    }
}

/// Returns true if the receiver answered within 20 s.
bool knock(net::UdpSocket& socket, const net::Endpoint& target)
{
    const auto end = net::monotonic_now() + 20s;
    while (net::monotonic_now() < end) {
        std::ignore = socket.send(target, {});
        net::wait_readable(std::array{socket.descriptor()}, net::monotonic_now() + 50ms);
        if (!socket.receive().empty()) return true;
    }
    return false;
}

int send(const std::string& where, int traffic_class, int count)
{
    const auto target = net::resolve(*net::parse_host_port(where));
    net::UdpSocket socket{net::resolve({"0.0.0.0", 0})};
    if (!knock(socket, target)) return 1;
    const auto set =
        setsockopt(socket.descriptor(), IPPROTO_IP, IP_TOS, &traffic_class, sizeof traffic_class);
    if (set != 0) return 1;
    std::array<int, 4> arrived{};
    int answers = 0;
    auto next = net::monotonic_now();
    const auto end = next + 20s;
    for (int sent = 0; answers < count && net::monotonic_now() < end;) {
        if (sent < count && net::monotonic_now() >= next) {
            std::ignore = socket.send(target, std::array<std::byte, 1000>{});
            next += ++sent < count ? base::Duration{1ms} : base::Duration{3s}; // then it gives up
        } else if (sent == count && net::monotonic_now() >= next) {
            break;
        }
        net::wait_readable(std::array{socket.descriptor()}, next);
        for (const net::Received& one : socket.receive()) {
            if (one.bytes.empty()) continue; // a late answer to a knock
            ++arrived.at(std::to_integer<std::size_t>(one.bytes.front()) & 3U);
            ++answers;
        }
    }
    std::printf("not-ect=%d ect1=%d ect0=%d ce=%d\n", arrived[0], arrived[1], arrived[2],
                arrived[3]);
    return 0;
}

} // namespace

int main(int argc, char* argv[])
{
    const std::span words{argv, static_cast<std::size_t>(argc)};
    if (argc == 3 && words[1] == std::string{"tell"}) tell(words[2]);
    if (argc == 5 && words[1] == std::string{"send"}) {
        return send(words[2], std::atoi(words[3]), std::atoi(words[4]));
    }
    return 2;
}

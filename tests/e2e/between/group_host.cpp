// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A member of a group of IPv4 that answers its sender, and a sender to a group or to all hosts:
//   group_host answer PORT GROUP
//   group_host send ADDRESS:PORT COUNT       prints how many were answered
// Both leave the choice of the interface to the system. The sender first knocks until one is
// answered: the other may begin later.
#include "proto/net/clock.hpp"
#include "proto/net/udp_socket.hpp"
#include "proto/net/wait.hpp"

#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <tuple>

namespace {

using namespace hapnet;
using namespace std::chrono_literals;

int answer(const std::string& port, const char* group)
{
    net::UdpSocket socket{net::resolve(*net::parse_host_port("0.0.0.0:" + port))};
    ip_mreq member{};
    inet_pton(AF_INET, group, &member.imr_multiaddr);
    if (setsockopt(socket.descriptor(), IPPROTO_IP, IP_ADD_MEMBERSHIP, &member, sizeof member) !=
        0) {
        std::fprintf(stderr, "cannot join %s: %s\n", group, std::strerror(errno));
        return 1;
    }
    while (true) {
        net::wait_readable(std::array{socket.descriptor()}, std::nullopt);
        for (const net::Received& one : socket.receive()) {
            std::ignore = socket.send(one.from, one.bytes);
        }
    }
}

/// Returns true if a datagram was answered within `patience`.
bool is_answered(net::UdpSocket& socket, const net::Endpoint& target, base::Duration patience)
{
    constexpr std::array payload{std::byte{1}};
    if (socket.send(target, payload) != net::SendOutcome::sent) return false;
    net::wait_readable(std::array{socket.descriptor()}, net::monotonic_now() + patience);
    return !socket.receive().empty();
}

int send(const std::string& where, int count)
{
    const auto target = net::resolve(*net::parse_host_port(where));
    net::UdpSocket socket{net::resolve({"0.0.0.0", 0})};
    const int yes = 1;
    setsockopt(socket.descriptor(), SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes);
    const auto end = net::monotonic_now() + 20s;
    while (net::monotonic_now() < end && !is_answered(socket, target, 200ms)) {
        net::sleep_until(net::monotonic_now() + 20ms);
    }
    int answered = 0;
    for (int i = 0; i < count; ++i) answered += is_answered(socket, target, 2s) ? 1 : 0;
    std::printf("%d of %d answered\n", answered, count);
    return answered == count ? 0 : 1;
}

} // namespace

int main(int argc, char** argv)
{
    const std::string what = argc == 4 ? argv[1] : "";
    if (what == "answer") return answer(argv[2], argv[3]);
    if (what == "send") return send(argv[2], std::atoi(argv[3]));
    std::fputs("group_host answer PORT GROUP | send ADDRESS:PORT COUNT\n", stderr);
    return 2;
}

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// A peer with a device loop of its own: example_peer :7101 127.0.0.1:7102, and beside it
// hapnet-peer --id 2 --listen :7102 --remote 127.0.0.1:7101 --task T1
#include <chrono>
#include <cmath>
#include <cstdio>
#include <hapnet/peer/core/peer.hpp>
#include <hapnet/proto/net/clock.hpp>
#include <hapnet/proto/net/udp_socket.hpp>

using namespace hapnet;
using namespace std::chrono_literals;

/// Returns a hand instead of a device's: it goes 20 mm to the right and back, every five seconds.
peer::Hand hand_at(base::TimePoint now)
{
    const double phase = 2.0 * M_PI * base::to_seconds(now.time_since_epoch()) / 5.0;
    const double speed = 2.0 * M_PI / 5.0 * 0.01 * std::sin(phase);
    return {.hip = {{-0.025 + 0.01 * (1.0 - std::cos(phase)), 0.0, 0.0}},
            .velocity = {{speed, 0.0, 0.0}}};
}

int main(int argc, char** argv)
{
    if (argc != 3) return std::fputs("usage: example_peer LISTEN REMOTE\n", stderr), 2;
    net::UdpSocket socket{net::resolve(net::parse_listen_address(argv[1]).value())};
    const net::Endpoint remote = net::resolve(net::parse_host_port(argv[2]).value());
    peer::Settings settings;
    settings.length = 10s;
    settings.introduction = {.id = 1,
                             .nonce = static_cast<std::uint32_t>(net::unpredictable_bits() | 1U),
                             .scene_hash = scene::hash(settings.scene),
                             .task = wire::TaskName::from_text("T1").value()};
    peer::Peer peer{settings};
    peer::Tick tick;
    for (base::TimePoint wake = net::monotonic_now(); !peer.finished(); wake += settings.tick) {
        net::sleep_until(wake);
        for (const net::Received& one : socket.receive()) {
            if (one.from == remote) peer.on_datagram(one.bytes, one.at);
        }
        tick = peer.tick(wake, hand_at(wake)); // tick.force is what the hand is to feel
        while (const auto datagram = peer.poll()) socket.send(remote, datagram->bytes());
    }
    const auto& counts = peer.counters();
    std::printf("%llu states heard, the cube is at %.2f mm\n",
                static_cast<unsigned long long>(counts.states), 1e3 * peer.position().x());
    return counts.states > 0 ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// spin_flows FLOWS DATAGRAMS: frames with UDP datagrams, one a millisecond each way, through a path
// of 160 ms with FLOWS flows, in turn, without a socket. Their additional instructions over those
// of a run without flows are the cost of flows.
#include "emulator/core/flow/packet_facts.hpp"
#include "emulator/core/frame.hpp"
#include "emulator/core/paths.hpp"

#include <array>
#include <chrono>
#include <cstdlib>
#include <spdlog/fmt/fmt.h>

namespace {

using namespace hapnet;
using emulator::Direction;

/// A frame from port 40000 to `port`.
std::array<std::byte, 178> frame_to(std::uint16_t port)
{
    constexpr std::array<unsigned char, 42> head{
        2,    0,    0, 0,   0, 0xb, 2, 0, 0,  0,  0, 0xa, 8,  0,                    // Ethernet
        0x45, 0,    0, 164, 0, 1,   0, 0, 64, 17, 0, 0,   10, 0, 0, 1, 10, 0, 0, 2, // IPv4
        0x9c, 0x40, 0, 0,   0, 144, 0, 0};                                          // UDP
    std::array<std::byte, 178> frame{};
    for (std::size_t i = 0; i < head.size(); ++i) frame[i] = static_cast<std::byte>(head[i]);
    frame[36] = static_cast<std::byte>(port >> 8);
    frame[37] = static_cast<std::byte>(port & 255);
    return frame;
}

/// Passes a datagram, as a port does.
void pass(emulator::Paths& paths, emulator::EmulatedPath& path, Direction direction,
          std::span<const std::byte> bytes, base::TimePoint now)
{
    const auto frame = emulator::read_frame(bytes);
    paths.advance(now);
    emulator::EmulatedPath* chosen = &path;
    if (emulator::Branches* branches = path.branches()) {
        now = branches->in_order(direction, now);
        if (const auto flow = branches->flow_of(emulator::facts_of(frame, bytes), now)) {
            chosen = branches->paths()[*flow];
        }
    }
    std::ignore = chosen->on_packet(direction, bytes, now, true,
                                    {.envelope_bytes = 42, .marks = frame.marks});
}

} // namespace

int main(int argc, char** argv)
{
    using namespace std::chrono_literals;
    if (argc != 3) return 2;
    const auto flows = static_cast<std::uint16_t>(std::atoi(argv[1]));
    emulator::Profile profile;
    profile.path.up.delay = profile.path.down.delay = emulator::constant(160ms);
    for (std::uint16_t i = 0; i < flows; ++i) {
        const auto port = static_cast<std::uint16_t>(5000 + i);
        profile.flows.push_back(
            {.name = fmt::format("f{}", i), .match = {.protocol = 17, .port = {{port, port}}}});
        profile.paths.push_back({fmt::format("flow.f{}", i), {}, {}});
        profile.paths.back().up.delay = emulator::constant(160ms);
        profile.paths.back().down.delay = emulator::constant(160ms);
    }
    emulator::Paths paths{profile,
                          {.slab = std::make_shared<emulator::Slab>(1 << 24),
                           .stream_detail = emulator::StreamDetail::nothing}};
    emulator::EmulatedPath& path = paths.add("");
    base::TimePoint now{};
    std::uint64_t left_over = 0;
    for (long left = std::atol(argv[2]); left > 0; left -= 2) {
        now += 1ms;
        const auto frame = frame_to(static_cast<std::uint16_t>(5000 + left / 2 % 17));
        for (const Direction each : {Direction::up, Direction::down}) {
            pass(paths, path, each, frame, now);
        }
        paths.each_due(now, [&](std::size_t number) {
            emulator::EmulatedPath& due = paths.at(number);
            for (const Direction each : {Direction::up, Direction::down}) {
                while (const auto datagram = due.poll(each, now)) {
                    due.on_sent(each, *datagram, now);
                    ++left_over;
                }
            }
        });
    }
    const auto rest = path.link(Direction::up).statistics().received;
    const bool are_apart = flows == 0 || 2 * rest < left_over;
    return left_over > 0 && are_apart ? 0 : 1;
}

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// spin_path watched|unwatched DATAGRAMS: state messages, one a millisecond each way, through a path
// of 160 ms without a socket.
#include "emulator/core/emulated_path.hpp"

#include <array>
#include <chrono>
#include <cstdlib>
#include <string_view>
#include <tuple>

int main(int argc, char** argv)
{
    using namespace hapnet;
    using namespace std::chrono_literals;
    using emulator::Direction;
    if (argc != 3) return 2;
    const bool is_watched = std::string_view{argv[1]} == "watched";
    emulator::Profile profile;
    profile.path.up.delay = emulator::constant(160ms);
    profile.path.down.delay = emulator::constant(160ms);
    emulator::EmulatedPath path{profile, {.stream_detail = emulator::StreamDetail::nothing}};
    constexpr std::array directions{Direction::up, Direction::down};
    for (const Direction each : directions) {
        if (is_watched) std::ignore = path.take_pulse(each);
    }
    const std::array<std::byte, 136> message{};
    base::TimePoint now{};
    for (long left = std::atol(argv[2]); left > 0; left -= 2) {
        now += 1ms;
        for (const Direction each : directions) {
            std::ignore = path.on_packet(each, message, now);
            while (const auto datagram = path.poll(each, now)) path.on_sent(each, *datagram, now);
        }
    }
    const auto delivered = path.link(Direction::up).statistics().delivered;
    const bool is_counted = path.take_pulse(Direction::up).count == delivered;
    return delivered > 0 && is_counted == is_watched ? 0 : 1;
}

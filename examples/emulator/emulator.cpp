// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
//
// An emulated path in virtual time: a minute of datagrams each way, in a moment, and the same for
// the same seed. No socket, no clock: time is an argument.
#include <algorithm>
#include <array>
#include <cstdio>
#include <hapnet/emulator/core/emulated_path.hpp>
#include <hapnet/emulator/core/profile/text.hpp>
#include <hapnet/proto/base/time.hpp>
#include <vector>

namespace {

using namespace hapnet;
using namespace std::chrono_literals;

constexpr const char* conditions = R"(
    both.delay = "40ms"
    both.jitter = { law = "uniform", half_width = "5ms", order = "free" }
    up.loss = "2%"
    [[at]]
    time = "30s"
    down.delay = "80ms"
)";

struct Way {
    std::vector<double> delays_ms;
    std::size_t sent = 0;
};

void note(Way& way, const emulator::Datagram& datagram, base::TimePoint at)
{
    way.delays_ms.push_back(1e3 * base::to_seconds(at - datagram.arrival));
}

/// Lets leave what is due until `now`.
void drain(emulator::EmulatedPath& path, std::array<Way, 2>& ways, base::TimePoint now)
{
    while (base::is_due(path.next_deadline(), now)) {
        const auto at = *path.next_deadline();
        path.advance(at);
        for (const auto direction : {emulator::Direction::up, emulator::Direction::down}) {
            while (const auto datagram = path.poll(direction, at)) {
                note(ways[static_cast<std::size_t>(direction)], *datagram, at);
                path.on_sent(direction, *datagram, at);
            }
        }
    }
}

} // namespace

int main()
{
    const auto profile = emulator::parse_profile(conditions, "conditions", {});
    if (!profile) return std::fprintf(stderr, "%s\n", profile.error().message.c_str()), 2;
    emulator::EmulatedPath path{*profile, {.seed = base::Seed{42}}};
    std::array<Way, 2> ways;
    const std::array<std::byte, 96> bytes{};
    for (base::TimePoint now{}; now < base::TimePoint{60s}; now += 1ms) {
        drain(path, ways, now);
        for (const auto direction : {emulator::Direction::up, emulator::Direction::down}) {
            path.on_packet(direction, bytes, now);
            ++ways[static_cast<std::size_t>(direction)].sent;
        }
    }
    drain(path, ways, base::TimePoint{70s});
    for (const char* const name : {"up", "down"}) {
        Way& way = ways[name[0] == 'u' ? 0 : 1];
        std::ranges::sort(way.delays_ms);
        std::printf("%-4s  %zu sent, %zu arrived, delay %.1f to %.1f ms, median %.1f ms\n", name,
                    way.sent, way.delays_ms.size(), way.delays_ms.front(), way.delays_ms.back(),
                    way.delays_ms[way.delays_ms.size() / 2]);
    }
}

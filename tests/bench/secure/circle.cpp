// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/secure/circle.hpp"

#include "tests/bench/common/timing.hpp"

#include <span>

namespace hapnet::bench {

using lab::virtual_time::VirtualPlayer;

Circle::Circle(const lab::virtual_time::Setting& setting) : inboxes_(setting.players.size())
{
    for (std::size_t seat = 0; seat < setting.players.size(); ++seat)
        players_.emplace_back(
            setting, lab::virtual_time::PlayerId{seat, static_cast<std::uint32_t>(11 + seat)});
}

double Circle::turn()
{
    now_ += std::chrono::milliseconds{1};
    const std::size_t last = players_.size() - 1;
    for (std::size_t seat = 0; seat < last; ++seat) play(seat);
    const std::int64_t begin = clock_ns();
    play(last);
    return static_cast<double>(clock_ns() - begin);
}

void Circle::play(std::size_t seat)
{
    VirtualPlayer& player = players_[seat];
    for (const Passing& passing : inboxes_[seat]) player.receive(passing.line, passing.bytes, now_);
    inboxes_[seat].clear();
    player.step(now_);
    player.send_all([&](std::size_t line, std::span<const std::byte> bytes, const auto&) {
        const std::size_t to = line < seat ? line : line + 1;
        inboxes_[to].push_back({seat < to ? seat : seat - 1, {bytes.begin(), bytes.end()}});
        if (seat == 0 && to == players_.size() - 1) newest_.assign(bytes.begin(), bytes.end());
    });
}

} // namespace hapnet::bench

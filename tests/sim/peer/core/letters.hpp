// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/random.hpp"
#include "tests/unit/peer/core/pair.hpp"

namespace hapnet::peer {

/// A path between two peers that delays, reorders, duplicates and loses by chance.
class Letters {
public:
    struct Way {
        base::Duration delay{40ms};
        std::uint32_t spread_us = 30'000; // on top of the delay, evenly
        double loss = 0.3;
        double duplication = 0.05;
    };

    explicit Letters(const Way& way) : way_{way} {}

    void send(std::size_t to, const wire::Datagram& datagram, base::TimePoint now)
    {
        const std::uint64_t number = sent_++;
        const double chance = stream_.uniform(number, 0);
        if (chance < way_.loss) return;
        const int copies = chance < way_.loss + way_.duplication ? 2 : 1;
        for (std::uint32_t copy = 0; copy < static_cast<std::uint32_t>(copies); ++copy) {
            const auto later =
                std::chrono::microseconds{stream_.below(way_.spread_us, number, 1 + copy)};
            letters_.push_back({to, datagram, now + way_.delay + later});
        }
    }

    /// `ahead`: the lead of each side's clock.
    void deliver(std::array<std::unique_ptr<Peer>, 2>& peers, base::TimePoint now,
                 const std::array<base::Duration, 2>& ahead = {})
    {
        const auto is_due = [now](const Letter& letter) { return letter.arrives <= now; };
        for (const Letter& letter : letters_) {
            if (is_due(letter)) {
                peers.at(letter.to)->on_datagram(letter.datagram.bytes(),
                                                 letter.arrives + ahead.at(letter.to));
            }
        }
        std::erase_if(letters_, is_due);
    }

private:
    struct Letter {
        std::size_t to = 0;
        wire::Datagram datagram;
        base::TimePoint arrives;
    };
    Way way_;
    base::RandomStream stream_ = base::Seed{7}.stream("letters");
    std::uint64_t sent_ = 0;
    std::vector<Letter> letters_;
};

} // namespace hapnet::peer

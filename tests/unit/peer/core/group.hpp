// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/random.hpp"
#include "tests/unit/peer/core/pair.hpp"

#include <map>

namespace hapnet::peer {

/// Up to eight peers, ids from 1, and a path between any two of them that delays, reorders and
/// loses by chance. A peer's hand stays where it is put, or does what `move` says.
class Group {
public:
    struct Path {
        base::Duration delay{0};
        std::uint32_t spread_us = 0; // on top of the delay, evenly
        double loss = 0.0;
        bool is_cut = false;
    };
    using Move = Hand (*)(std::size_t side, base::Duration since_start);

    explicit Group(std::size_t size, base::Seed seed = base::Seed{1})
        : stream_{seed.stream("group")}, peers(size), hands(size), ticks(size), events(size)
    {
        paths.resize(size * size);
        hands.assign(size, Hand{.hip = {{0.0, 0.2, 0.0}}, .velocity = {}});
    }

    void start(std::size_t side, const Settings& settings)
    {
        peers[side] = std::make_unique<Peer>(settings);
    }
    void start(std::size_t side) { start(side, settings_of_group(side)); }
    void start_all()
    {
        for (std::size_t side = 0; side < peers.size(); ++side) start(side);
    }
    void kill(std::size_t side) { peers[side].reset(); }

    /// The settings of a peer in a group, with the others' ids.
    [[nodiscard]] Settings settings_of_group(std::size_t side)
    {
        Settings settings = settings_of(side, ++runs_);
        settings.roster.others.clear();
        for (std::size_t other = 0; other < peers.size(); ++other) {
            if (other != side)
                settings.roster.others.push_back(static_cast<std::uint16_t>(other + 1));
        }
        return settings;
    }

    [[nodiscard]] Path& path(std::size_t from, std::size_t to)
    {
        return paths[from * peers.size() + to];
    }
    /// Cuts both directions between two peers.
    void cut(std::size_t a, std::size_t b, bool is_cut)
    {
        path(a, b).is_cut = is_cut;
        path(b, a).is_cut = is_cut;
    }
    void isolate(std::size_t side, bool is_cut)
    {
        for (std::size_t other = 0; other < peers.size(); ++other)
            if (other != side) cut(side, other, is_cut);
    }

    void step()
    {
        now += 1ms;
        while (!letters_.empty() && letters_.begin()->first <= now) {
            const auto& [arrives, letter] = *letters_.begin();
            if (peers[letter.to])
                peers[letter.to]->on_datagram(letter.datagram.bytes(), arrives,
                                              place(letter.to, letter.from));
            letters_.erase(letters_.begin());
        }
        for (std::size_t side = 0; side < peers.size(); ++side) {
            if (peers[side]) play(side);
        }
    }
    void run_for(base::Duration duration)
    {
        for (const auto end = now + duration; now < end;) step();
    }

    /// True if all play, and hear all others.
    [[nodiscard]] bool all_play() const
    {
        return std::ranges::all_of(peers, [this](const auto& peer) {
            return peer && peer->session() && now >= peer->session()->start &&
                   std::ranges::all_of(peer->others(), [this](const Remote& other) {
                       return other.freshness_at(now) > 0.0;
                   });
        });
    }
    [[nodiscard]] bool told(std::size_t side, Event event, std::uint16_t about = 0) const
    {
        return std::ranges::any_of(events[side], [&](const Notice& notice) {
            return notice.event == event && (about == 0 || notice.about == about);
        });
    }
    /// Returns the largest distance between the copies of the body.
    [[nodiscard]] double apart_m() const
    {
        double most = 0.0;
        for (const auto& a : peers)
            for (const auto& b : peers)
                if (a && b) most = std::max(most, base::norm(a->position() - b->position()));
        return most;
    }

private:
    struct Letter {
        std::size_t to = 0, from = 0;
        wire::Datagram datagram;
    };
    /// Returns the place of `other` in the roster of `side`.
    [[nodiscard]] static std::size_t place(std::size_t side, std::size_t other)
    {
        return other < side ? other : other - 1;
    }

    void play(std::size_t side)
    {
        Peer& peer = *peers[side];
        if (move != nullptr && peer.session())
            hands[side] = move(side, now - peer.session()->start);
        ticks[side] = peer.tick(now, hands[side]);
        for (std::size_t to = 0; to < peers.size(); ++to) {
            if (to == side) continue;
            while (const auto datagram = peer.poll(place(side, to))) send(side, to, *datagram);
        }
        while (const auto notice = peer.notice()) events[side].push_back(*notice);
    }
    void send(std::size_t from, std::size_t to, const wire::Datagram& datagram)
    {
        const Path& way = path(from, to);
        const std::uint64_t number = sent_++;
        if (way.is_cut || stream_.uniform(number, 0) < way.loss) return;
        const auto later = std::chrono::microseconds{
            way.spread_us == 0 ? 0 : stream_.below(way.spread_us, number, 1)};
        letters_.emplace(now + way.delay + later, Letter{to, from, datagram});
    }

    base::RandomStream stream_;
    std::uint64_t sent_ = 0;
    std::uint32_t runs_ = 0;
    std::multimap<base::TimePoint, Letter> letters_; // by their arrival

public:
    base::TimePoint now{1h};
    std::vector<std::unique_ptr<Peer>> peers;
    std::vector<Hand> hands;
    std::vector<Tick> ticks;
    std::vector<std::vector<Notice>> events;
    std::vector<Path> paths; // from * size + to
    Move move = nullptr;
};

} // namespace hapnet::peer

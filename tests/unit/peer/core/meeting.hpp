// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/handshake.hpp"
#include "proto/base/random.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <vector>

namespace hapnet::peer {

/// The effect of the path between two handshakes on each message.
struct Path {
    base::Duration delay_min{};
    base::Duration delay_max{};
    double loss = 0.0;
    double duplication = 0.0;
    base::Duration longer_back{}; // from side 1 to side 0
};

/// Introduces side 0 (id 1) or side 1 (id 2) as its `run`-th run.
[[nodiscard]] inline Introduction introduction(std::size_t side, std::uint32_t run = 0)
{
    Introduction self;
    self.id = static_cast<std::uint16_t>(side + 1);
    self.nonce = static_cast<std::uint32_t>(1000 * (side + 1) + run);
    self.scene_hash = 77;
    self.seed = 100 * (side + 1) + run;
    self.task = wire::TaskName::from_text("T3").value();
    return self;
}

/// Two handshakes and the path between them, a millisecond at a time. Once in session, a side
/// also sends states, which say no more than that it knows the start.
class Meeting {
public:
    explicit Meeting(const Path& path, base::Seed seed = base::Seed{1})
        : path_{path}, stream_{seed.stream("meeting")}
    {
        restart(0);
        restart(1);
    }

    void step()
    {
        now += std::chrono::milliseconds{1};
        ++tick_;
        for (const std::size_t to : {0U, 1U}) deliver(to);
        for (const std::size_t from : {0U, 1U}) {
            if (!sides[from]) continue;
            if (const auto hello = sides[from]->hello(clock(from), 0)) {
                ++hellos[from];
                send({1 - from, *hello, 0, now});
            }
            if (sides[from]->session() && tick_ % state_every == 0) {
                send({1 - from, std::nullopt, sides[from]->session()->number, now});
            }
        }
    }

    void run_for(base::Duration duration)
    {
        for (const auto end = now + duration; now < end;) step();
    }

    /// Returns the side's time of day.
    [[nodiscard]] base::TimePoint clock(std::size_t side) const { return now + ahead[side]; }

    void kill(std::size_t side) { sides[side].reset(); }
    void restart(std::size_t side)
    {
        Introduction self = introduction(side, runs_++);
        self.clock = boot;
        sides[side].emplace(self);
    }

    /// True if both are in the same session and know the same about it.
    [[nodiscard]] bool agree() const
    {
        if (!sides[0] || !sides[1]) return false;
        const auto& a = sides[0]->session();
        const auto& b = sides[1]->session();
        return a && b && a->number == b->number && a->seed == b->seed && a->is_left && !b->is_left;
    }

    /// Returns the difference between the two starts.
    [[nodiscard]] base::Duration start_error() const
    {
        return std::chrono::abs((sides[0]->session()->start - ahead[0]) -
                                (sides[1]->session()->start - ahead[1]));
    }

    base::TimePoint now{std::chrono::hours{1}};
    std::array<std::optional<Handshake>, 2> sides;
    std::array<base::Duration, 2> ahead{};
    std::uint32_t boot = 0; // of both machines, which reboots change
    std::array<int, 2> hellos{};

private:
    struct Letter {
        std::size_t to = 0;
        std::optional<wire::Hello> hello; // nullopt: a state
        std::uint32_t session = 0;
        base::TimePoint arrives;
    };

    void send(Letter letter)
    {
        const std::uint64_t number = sent_++;
        if (stream_.uniform(number, 0) < path_.loss) return;
        const double spread = base::to_seconds(path_.delay_max - path_.delay_min);
        const int copies = stream_.uniform(number, 1) < path_.duplication ? 2 : 1;
        for (std::uint32_t copy = 0; copy < static_cast<std::uint32_t>(copies); ++copy) {
            letter.arrives = now + path_.delay_min +
                             (letter.to == 0 ? path_.longer_back : base::Duration{}) +
                             base::from_seconds(spread * stream_.uniform(number, 2 + copy));
            letters_.push_back(letter);
            await(letter);
        }
    }

    void await(const Letter& letter)
    {
        auto& next = next_[letter.to];
        next = next ? std::min(*next, letter.arrives) : letter.arrives;
    }

    void deliver(std::size_t to)
    {
        if (!next_[to] || now < *next_[to]) return; // looking through all letters is slow
        const auto is_due = [&](const Letter& l) { return l.to == to && l.arrives <= now; };
        std::vector<Letter> due;
        std::copy_if(letters_.begin(), letters_.end(), std::back_inserter(due), is_due);
        std::erase_if(letters_, is_due);
        next_[to].reset();
        for (const Letter& letter : letters_) {
            if (letter.to == to) await(letter);
        }
        std::stable_sort(due.begin(), due.end(),
                         [](const Letter& x, const Letter& y) { return x.arrives < y.arrives; });
        for (const Letter& letter : due) {
            if (!sides[to]) continue;
            Handshake& side = *sides[to];
            if (letter.hello) {
                std::ignore = side.on_hello(*letter.hello, letter.arrives + ahead[to]);
            } else if (side.session() && side.session()->number == letter.session) {
                side.on_state();
            }
        }
    }

    static constexpr int state_every = 10; // ticks: enough to be heard

    int tick_ = 0;
    Path path_;
    base::RandomStream stream_;
    std::uint64_t sent_ = 0;
    std::uint32_t runs_ = 1;
    std::vector<Letter> letters_;
    std::array<std::optional<base::TimePoint>, 2> next_; // arrival at each side
};

} // namespace hapnet::peer

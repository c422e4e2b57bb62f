// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/virtual_time/world.hpp"
#include "proto/base/random.hpp"
#include "proto/wire/message.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

namespace hapnet::test {

/// What an attacker on the path does, as probabilities from 0 to 1.
struct Habits {
    // Of each datagram.
    double drop = 0.0;
    double hold = 0.0;     // for up to held_for
    double copy = 0.0;     // it comes once more, up to held_for later
    double flip = 0.0;     // one to eight of its bits
    double redirect = 0.0; // it comes from another place
    double resize = 0.0;
    base::Duration held_for{std::chrono::seconds{2}};
    // In each millisecond, on each way from a side to another.
    double replay = 0.0;  // a datagram of any time and any run
    double reflect = 0.0; // one that the victim sent itself, or that is between others
    double splice = 0.0;  // the head of one and the tail of another
    double forge = 0.0; // a message in the other side's name, with the session's number or its key
    double storm = 0.0; // a burst of hellos of other runs, of handshakes, of noise
    double silence = 0.0; // nothing passes from now on, for up to held_for
};

/// An attacker who owns the paths between all sides of a world of one group: he sees every datagram
/// when it arrives and decides what the side hears. What he does follows from the seed. Call act()
/// after each step of the world. The world must outlive him and may not move.
///
/// He also keeps the book of what sealed sides accept: breach() tells of a message that the side in
/// whose name it came has not sealed for this one and this run, or that was accepted twice.
class Mallory {
public:
    Mallory(lab::virtual_time::VirtualWorld& world, base::Seed seed, const Habits& habits);

    /// What he does of himself: replays, forgeries, and what he has held back until now.
    void act();
    /// From now on he lets everything through, and throws away what he still holds.
    void leave();

    /// Datagrams given to a side so far, in all of its runs, and messages that its lines let in.
    [[nodiscard]] std::uint64_t given(std::size_t to) const { return given_[to]; }
    [[nodiscard]] std::uint64_t let_in(std::size_t to) const { return let_in_[to]; }
    [[nodiscard]] const std::optional<std::string>& breach() const { return breach_; }
    /// The side is another run now.
    void note_restart(std::size_t side) { ++runs_[side]; }

private:
    using Bytes = std::vector<std::byte>;
    struct Entry {
        std::uint64_t run = 0; // of the side that it went to
        bool is_accepted = false;
    };
    /// From one side to another, and what he has seen on it.
    struct Way {
        std::size_t from = 0;
        std::size_t to = 0;
        std::size_t line = 0; // of the side that it leads to
        std::uint64_t seen = 0;
        std::vector<Bytes> remembered{};
        std::optional<wire::State> state{};
        std::optional<wire::Hello> hello{};
        base::TimePoint silent_until{};
        std::unordered_map<std::string, Entry> book{}; // of all that came, by its bytes
    };
    struct Letter {
        std::size_t way = 0;
        Bytes bytes;
        base::TimePoint due;
    };
    static constexpr std::size_t remembered_max = 1024; // of all that went to a side

    [[nodiscard]] std::size_t way_between(std::size_t from, std::size_t to) const;
    void on_arrival(std::size_t way, std::span<const std::byte> datagram, base::TimePoint arrived);
    void remember(Way& way, std::span<const std::byte> datagram);
    void give(const Way& way, std::span<const std::byte> datagram, base::TimePoint arrived);
    void give_from(const Way& way, std::span<const std::byte> datagram, const secure::Place& from,
                   base::TimePoint arrived);
    void audit(std::size_t way, std::span<const std::byte> datagram);
    void hold(const Way& way, std::span<const std::byte> datagram);

    void attack(Way& way);
    [[nodiscard]] const Way& another(const Way& way);
    void replay(const Way& way, const Way& source);
    void splice(const Way& way);
    void forge(const Way& way);
    void storm(const Way& way);
    void forge_sealed(const Way& way);
    void forge_plain(const Way& way);
    [[nodiscard]] wire::State forged(wire::State state);
    [[nodiscard]] wire::Hello forged(wire::Hello hello);
    void damage(Bytes& bytes);

    [[nodiscard]] double chance() { return draw_.uniform(drawn_++); }
    [[nodiscard]] bool happens(double probability) { return chance() < probability; }
    [[nodiscard]] std::size_t below(std::size_t bound)
    {
        return draw_.below(static_cast<std::uint32_t>(bound), drawn_++);
    }
    [[nodiscard]] base::Duration up_to(base::Duration most)
    {
        return base::from_seconds(chance() * base::to_seconds(most));
    }

    lab::virtual_time::VirtualWorld& world_;
    Habits habits_;
    base::RandomStream draw_;
    std::uint64_t drawn_ = 0;
    bool is_there_ = true;
    std::vector<Way> ways_;             // by the side that they lead to, and where they come from
    std::vector<std::uint64_t> given_;  // by the side that it was given to
    std::vector<std::uint64_t> let_in_; // likewise
    std::vector<std::uint64_t> runs_;   // restarts so far
    std::vector<Letter> held_;
    std::optional<std::string> breach_;
};

} // namespace hapnet::test

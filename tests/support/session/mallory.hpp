// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/virtual_time/world.hpp"
#include "proto/base/random.hpp"
#include "proto/wire/message.hpp"

#include <array>
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
    // In each millisecond, to each side.
    double replay = 0.0;  // a datagram of any time and any run
    double reflect = 0.0; // one that the victim sent itself
    double splice = 0.0;  // the head of one and the tail of another
    double forge = 0.0; // a message in the other side's name, with the session's number or its key
    double storm = 0.0; // a burst of hellos of other runs, of handshakes, of noise
    double silence = 0.0; // nothing passes from now on, for up to held_for
};

/// An attacker who owns the path between the two sides of a world's first pair: he sees every
/// datagram when it arrives and decides what the side hears. What he does follows from the seed.
/// Call act() after each step of the world. The world must outlive him and may not move.
///
/// He also keeps the book of what sealed sides accept: breach() tells of a message that the other
/// side has not sealed for this run, or that was accepted twice.
class Mallory {
public:
    Mallory(lab::virtual_time::VirtualWorld& world, base::Seed seed, const Habits& habits);

    /// What he does of himself: replays, forgeries, and what he has held back until now.
    void act();
    /// From now on he lets everything through, and throws away what he still holds.
    void leave();

    /// Datagrams given to a side so far, in all of its runs, and messages that its line let in.
    [[nodiscard]] std::uint64_t given(std::size_t to) const { return given_.at(to); }
    [[nodiscard]] std::uint64_t let_in(std::size_t to) const { return let_in_.at(to); }
    [[nodiscard]] const std::optional<std::string>& breach() const { return breach_; }
    /// The side is another run now.
    void note_restart(std::size_t side) { ++runs_.at(side); }

private:
    using Bytes = std::vector<std::byte>;
    struct Letter {
        std::size_t to = 0;
        Bytes bytes;
        base::TimePoint due;
    };
    static constexpr std::size_t remembered_max = 1024; // of all that went to a side

    void on_arrival(std::size_t to, std::span<const std::byte> datagram, base::TimePoint arrived);
    void remember(std::size_t to, std::span<const std::byte> datagram);
    void give(std::size_t to, std::span<const std::byte> datagram, base::TimePoint arrived);
    void give_from(std::size_t to, std::span<const std::byte> datagram, const secure::Place& from,
                   base::TimePoint arrived);
    void audit(std::size_t to, std::span<const std::byte> datagram);
    void hold(std::size_t to, std::span<const std::byte> datagram);

    void attack(std::size_t to);
    void replay(std::size_t to, std::size_t sent_to);
    void splice(std::size_t to);
    void forge(std::size_t to);
    void storm(std::size_t to);
    void forge_sealed(std::size_t to);
    void forge_plain(std::size_t to);
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
    std::array<std::uint64_t, 2> given_{};
    std::array<std::uint64_t, 2> let_in_{};
    std::array<std::uint64_t, 2> seen_{};
    std::array<std::vector<Bytes>, 2> remembered_; // by the side that it went to
    std::array<std::optional<wire::State>, 2> state_;
    std::array<std::optional<wire::Hello>, 2> hello_;
    std::array<base::TimePoint, 2> silent_until_{};
    std::vector<Letter> held_;

    struct Entry {
        std::uint64_t run = 0; // of the side that it went to
        bool is_accepted = false;
    };
    std::array<std::uint64_t, 2> runs_{};                        // restarts so far
    std::array<std::unordered_map<std::string, Entry>, 2> book_; // of all that came, by its bytes
    std::optional<std::string> breach_;
};

} // namespace hapnet::test

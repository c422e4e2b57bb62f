// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/emulated_path.hpp"
#include "lab/virtual_time/player.hpp"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace hapnet::lab::virtual_time {

/// Pairs of players and the links between them on one timeline, which jumps from deadline to
/// deadline: to the next tick of any player, or to the next step of a profile. A datagram that is
/// due between two ticks of its receiver waits in the receiver's socket: it is handed over at the
/// next tick, stamped with the time at which it was due.
///
/// Sides are counted through: those of pair p are 2p, its L, and 2p + 1, its R.
class VirtualWorld {
public:
    /// When every world begins, and the timelines of its profiles.
    static constexpr base::TimePoint start{std::chrono::seconds{1000}};
    /// The default bound on the datagrams in a link: 1 s of them, which fit into a processor's
    /// cache. Memory for the emulator's own bound would take longer to set up than a session takes.
    static constexpr emulator::QueueLimits few{.datagrams_max = 1024, .bytes_max = 4U << 20};

    /// One pair. The setting must be valid: see validate().
    explicit VirtualWorld(const Setting& setting, emulator::QueueLimits limits = few);
    /// One pair for each setting.
    explicit VirtualWorld(std::span<const Setting> settings, emulator::QueueLimits limits = few);

    /// To the next deadline, and all that happens then.
    void step();
    /// All that happens within `duration` from now, its end included.
    void run_for(base::Duration duration);

    /// Kills a side on the spot; nothing is said.
    void kill(std::size_t side) { sides_[side].player.reset(); }
    /// Starts it again as a new run.
    void revive(std::size_t side);
    [[nodiscard]] bool is_alive(std::size_t side) const { return sides_[side].player.has_value(); }
    /// Nothing passes between the sides of a pair while it is true.
    void cut(bool is_cut, std::size_t pair = 0) { pairs_[pair].is_cut = is_cut; }

    /// Somebody between the links and the sides, who is called with each datagram in the place of
    /// the side that it is for, and gives that side what he wants: VirtualPlayer::receive().
    using Interceptor = std::function<void(std::size_t to, std::span<const std::byte> datagram,
                                           base::TimePoint arrived)>;
    void intercept(Interceptor interceptor) { interceptor_ = std::move(interceptor); }

    [[nodiscard]] VirtualPlayer& side(std::size_t index) { return *sides_[index].player; }
    [[nodiscard]] const VirtualPlayer& side(std::size_t index) const
    {
        return *sides_[index].player;
    }
    [[nodiscard]] const Setting& setting(std::size_t pair = 0) const
    {
        return pairs_[pair].setting;
    }
    [[nodiscard]] base::TimePoint now() const { return now_; }
    [[nodiscard]] std::size_t sides() const { return sides_.size(); }
    [[nodiscard]] const emulator::Link& link(std::size_t from) const
    {
        return pairs_[from / 2].path.link(direction_of(from));
    }

private:
    /// Undelayed: it left at once, and waits in the receiver's socket.
    struct Passing {
        emulator::Datagram departure; // but for its bytes
        peer::line::Datagram datagram;
    };
    /// The part of a side that outlives a killed player.
    struct Side {
        std::optional<VirtualPlayer> player;
        std::vector<Passing> undelayed;
        base::TimePoint next_tick;
        base::Duration tick;
    };
    struct Pair {
        Setting setting;
        emulator::EmulatedPath path;
        std::uint32_t next_nonce = 100;
        bool is_cut = false;
    };

    void add(const Setting& setting, emulator::QueueLimits limits);
    /// Of what a side sends.
    [[nodiscard]] static emulator::Direction direction_of(std::size_t side)
    {
        return side % 2 == 0 ? emulator::Direction::up : emulator::Direction::down;
    }
    [[nodiscard]] base::TimePoint next_deadline() const;
    void deliver(std::size_t to);
    void hand_over(std::size_t to, std::span<const std::byte> datagram, base::TimePoint arrived);
    void play(std::size_t side);

    base::TimePoint now_ = start;
    std::vector<Pair> pairs_;
    std::vector<Side> sides_; // two of each pair
    Interceptor interceptor_;
};

} // namespace hapnet::lab::virtual_time

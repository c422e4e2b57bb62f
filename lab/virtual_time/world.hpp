// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/emulated_path.hpp"
#include "emulator/core/paths.hpp"
#include "lab/virtual_time/player.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace hapnet::lab::virtual_time {

/// Players in groups of two to eight, each group a session, and links between any two players of a
/// group, on one timeline. The timeline jumps from deadline to deadline: to the next tick of any
/// player, or to the next step of a profile. A datagram that is due between two ticks of its
/// receiver waits in the receiver's socket. It is handed over at the next tick, stamped with the
/// time at which it was due.
///
/// The sides, one for each player, are numbered group after group. In the first group the number of
/// a side is its seat. The random draws of a link are those of an emulator with this link: see
/// links_between().
class VirtualWorld {
public:
    /// The time when every world and the timelines of its profiles begin.
    static constexpr base::TimePoint start{std::chrono::seconds{1000}};
    /// The default bound on the datagrams in a link: 1 s of them, which fit into a processor's
    /// cache. It takes longer to set up memory for the emulator's own bound than to play a session.
    static constexpr emulator::QueueLimits few{.datagrams_max = 1024, .bytes_max = 4U << 20};

    /// A world of one group. The setting must be valid: see validate().
    explicit VirtualWorld(const Setting& setting, emulator::QueueLimits limits = few);
    /// A world with one group for each setting.
    explicit VirtualWorld(std::span<const Setting> settings, emulator::QueueLimits limits = few);
    // These are defined in world.cpp, so that not every file that uses a VirtualWorld compiles
    // them.
    ~VirtualWorld();
    VirtualWorld(VirtualWorld&&) noexcept;
    VirtualWorld& operator=(VirtualWorld&&) noexcept;
    VirtualWorld(const VirtualWorld&) = delete;
    VirtualWorld& operator=(const VirtualWorld&) = delete;

    /// Advances to the next deadline, and does everything that is due then.
    void step();
    /// Returns the time of the next deadline.
    [[nodiscard]] base::TimePoint next_deadline() const;
    /// Plays everything that happens within `duration` from now, its end included.
    void run_for(base::Duration duration);

    /// Kills a side at once. It sends no goodbye.
    void kill(std::size_t side) { sides_[side].player.reset(); }
    /// Starts a killed side again as a new run.
    void revive(std::size_t side);
    [[nodiscard]] bool is_alive(std::size_t side) const { return sides_[side].player.has_value(); }
    /// Blocks all datagrams between two sides of a group while `is_cut` is true.
    void cut(std::size_t a, std::size_t b, bool is_cut);
    /// Cuts a side off from all others of its group while `is_cut` is true.
    void isolate(std::size_t side, bool is_cut);

    /// A datagram that a link has carried from one side to another.
    struct Arrival {
        std::size_t from = 0;
        std::size_t to = 0;
        std::span<const std::byte> datagram;
        base::TimePoint at;
    };
    /// A function between the links and the sides. It gets each datagram instead of the side for
    /// which the datagram is meant. It may pass any bytes to that side by VirtualPlayer::receive().
    using Interceptor = std::function<void(const Arrival& arrival)>;
    void intercept(Interceptor interceptor) { interceptor_ = std::move(interceptor); }

    [[nodiscard]] VirtualPlayer& side(std::size_t index) { return *sides_[index].player; }
    [[nodiscard]] const VirtualPlayer& side(std::size_t index) const
    {
        return *sides_[index].player;
    }
    [[nodiscard]] const Setting& setting(std::size_t group = 0) const
    {
        return groups_[group].setting;
    }
    /// Returns the links of a group. Their conditions may be changed between two steps.
    [[nodiscard]] emulator::Paths& paths(std::size_t group = 0) { return groups_[group].paths; }
    [[nodiscard]] std::size_t groups() const { return groups_.size(); }
    /// Returns the group of a side. seat_of() returns its seat there.
    [[nodiscard]] std::size_t group_of(std::size_t side) const { return sides_[side].group; }
    [[nodiscard]] std::size_t seat_of(std::size_t side) const
    {
        return side - groups_[sides_[side].group].first_side;
    }
    [[nodiscard]] base::TimePoint now() const { return now_; }
    [[nodiscard]] std::size_t sides() const { return sides_.size(); }
    /// Returns the link from a side to another one of its group.
    [[nodiscard]] const emulator::Link& link(std::size_t from, std::size_t to) const
    {
        const Way& way = ways_[way_between(from, to)];
        return way.path->link(way.direction);
    }

private:
    /// A datagram that the link did not delay. It waits in the receiver's socket.
    struct Passing {
        emulator::Datagram departure; // everything about the datagram except its bytes
        peer::line::Datagram datagram;
    };
    /// The part of a side that outlives a killed player.
    struct Side {
        std::optional<VirtualPlayer> player;
        std::size_t group = 0;
        /// The index in `ways_` of the first direction from this side. There is one to each other
        /// side, by seat.
        std::size_t first_out = 0;
        /// The indices in `ways_` of the directions to this side, in the order of the senders'
        /// seats.
        std::vector<std::size_t> ins{};
        base::TimePoint next_tick;
        base::Duration tick;
        std::shared_ptr<const std::vector<base::Duration>> ticks{}; // see PlayerSetting::ticks
        std::size_t ticks_begun = 0; // number of `ticks` that have begun
    };
    /// The direction from one side of a group to another.
    struct Way {
        emulator::EmulatedPath* path;
        emulator::Direction direction;
        std::size_t from = 0;
        secure::Place begin{}; // place of the sender on the network
        secure::Place end{};   // place of the receiver on the network
        std::size_t line = 0;  // number of the receiver's line to the sender
        bool is_cut = false;
        std::vector<Passing> undelayed{};
    };
    struct Group {
        Setting setting;
        emulator::Paths paths;
        std::size_t first_side = 0;
        std::size_t size = 0; // number of sides
        std::uint32_t next_nonce = 100;
    };

    void add(const Setting& setting, emulator::QueueLimits limits);
    void add_ways(Group& group);
    [[nodiscard]] std::size_t way_between(std::size_t from, std::size_t to) const
    {
        const std::size_t seat = seat_of(to);
        return sides_[from].first_out + (to < from ? seat : seat - 1);
    }
    void deliver(std::size_t to);
    void hand_over(std::size_t to, const Way& way, const emulator::Datagram& datagram);
    void play(std::size_t side);
    [[nodiscard]] base::TimePoint tick_after(Side& side) const;

    base::TimePoint now_ = start;
    std::vector<Group> groups_;
    std::vector<Side> sides_; // the sides of all groups, group after group
    std::vector<Way> ways_;
    Interceptor interceptor_;
};

} // namespace hapnet::lab::virtual_time

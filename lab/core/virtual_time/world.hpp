// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/governor.hpp"
#include "device/simulated/omni.hpp"
#include "emulator/core/conditions.hpp"
#include "emulator/core/link.hpp"
#include "peer/core/peer.hpp"

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace hapnet::sim {

/// The conditions of a simulated session.
struct Setting {
    device::Task task = device::Task::p1;
    base::Seed seed{42};
    base::Duration length{std::chrono::seconds{30}};
    emulator::Conditions up;
    emulator::Conditions down;
};

/// One side: everything a peer daemon has but sockets, clock and threads.
struct Side {
    Side(const Setting& setting, std::uint16_t id, std::uint32_t nonce);

    std::unique_ptr<device::SimulatedOmni> omni;
    std::unique_ptr<peer::Peer> peer;
    device::Governor governor{{}};
    peer::Tick last;
    base::Force applied;
    std::vector<peer::Event> events;
    std::optional<base::TimePoint> cued; // the start it was cued for
    base::Duration clock_ahead{};        // of the world's time
    std::uint16_t id;
};

/// Two peers, two links and two simulated hands in virtual time, one tick after another.
class World {
public:
    explicit World(const Setting& setting);

    /// One millisecond.
    void step();
    void run_for(base::Duration duration);
    /// Until both run, at most 10 s.
    void run_until_started();

    /// Kills a side on the spot; nothing is said.
    void kill(std::size_t side);
    /// Starts it again as a new run.
    void revive(std::size_t side);
    [[nodiscard]] bool is_alive(std::size_t side) const { return sides_[side].has_value(); }

    [[nodiscard]] Side& side(std::size_t index) { return *sides_[index]; }
    [[nodiscard]] const Side& side(std::size_t index) const { return *sides_[index]; }
    [[nodiscard]] base::TimePoint now() const { return now_; }
    /// |x_A - x_B| of the cubes, metres.
    [[nodiscard]] double discrepancy_x() const;
    [[nodiscard]] const emulator::Link& link(std::size_t from) const { return links_[from]; }
    /// Nothing passes while it is true.
    void cut(bool is_cut) { cut_ = is_cut; }

private:
    /// Undelayed: it arrives in the next millisecond all the same.
    struct Passing {
        emulator::Departure departure;
        std::vector<std::byte> bytes;
    };

    void deliver(std::size_t from);
    void turn(std::size_t index);

    Setting setting_;
    base::TimePoint now_{std::chrono::seconds{1000}};
    std::array<std::optional<Side>, 2> sides_;
    std::array<emulator::Link, 2> links_;
    std::array<std::vector<Passing>, 2> undelayed_;
    std::uint32_t next_nonce_ = 100;
    bool cut_ = false;
};

} // namespace hapnet::sim

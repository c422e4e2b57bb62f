// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/virtual_time/world.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace hapnet::sim {

using World = lab::virtual_time::VirtualWorld;
using Player = lab::virtual_time::VirtualPlayer;
using lab::virtual_time::Setting;

/// |x_A - x_B| of the cubes, metres.
[[nodiscard]] inline double discrepancy_x(const World& world)
{
    return std::abs(world.side(0).peer().body().position.x() -
                    world.side(1).peer().body().position.x());
}

/// Plays until both peers run, at most 10 s.
inline void run_until_started(World& world)
{
    const auto end = world.now() + std::chrono::seconds{10};
    const auto runs = [&](std::size_t i) {
        return world.side(i).last().phase == peer::Phase::running;
    };
    while (world.now() < end && !(runs(0) && runs(1))) world.step();
}

/// Mean, deviation and maximum of added values.
class Spread {
public:
    void add(double value)
    {
        ++count_;
        sum_ += value;
        squares_ += value * value;
        most_ = std::max(most_, value);
    }

    [[nodiscard]] int count() const { return count_; }
    [[nodiscard]] double mean() const { return sum_ / count_; }
    [[nodiscard]] double deviation() const
    {
        return std::sqrt(squares_ / count_ - mean() * mean());
    }
    [[nodiscard]] double most() const { return most_; }

private:
    int count_ = 0;
    double sum_ = 0.0;
    double squares_ = 0.0;
    double most_ = 0.0;
};

/// The score of a session while both sides run.
struct Score {
    Spread discrepancy_mm;
    std::array<Spread, 2> force_n; // that each hand was given
};

/// Plays a session to its end.
[[nodiscard]] inline Score play(World& world)
{
    Score score;
    run_until_started(world);
    while (world.side(0).last().phase == peer::Phase::running) {
        score.discrepancy_mm.add(1e3 * discrepancy_x(world));
        for (const std::size_t i : {0U, 1U}) {
            score.force_n.at(i).add(base::norm(world.side(i).told()));
        }
        world.step();
    }
    return score;
}

/// Returns a setting with equal conditions in both directions.
[[nodiscard]] inline Setting under(device::Task task, const emulator::Conditions& conditions)
{
    Setting setting{.task = task};
    setting.profile.path = {conditions, conditions};
    return setting;
}

/// FNV-1a over the bits of the numbers added.
class Hash {
public:
    void add(double value)
    {
        const auto bits = std::bit_cast<std::uint64_t>(value);
        for (unsigned shift = 0; shift < 64; shift += 8) {
            hash_ ^= (bits >> shift) & 0xffU;
            hash_ *= 0x100000001b3U;
        }
    }
    void add(const World& world, std::size_t index)
    {
        const Player& side = world.side(index);
        for (const auto& v : {side.peer().body().position.value, side.told().value}) {
            add(v.x);
            add(v.y);
            add(v.z);
        }
    }

    [[nodiscard]] std::uint64_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0xcbf29ce484222325U;
};

} // namespace hapnet::sim

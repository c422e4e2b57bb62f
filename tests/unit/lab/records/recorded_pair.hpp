// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/governor/limits_text.hpp"
#include "device/rig.hpp"
#include "peer/core/side.hpp"
#include "peer/core/sync/text.hpp"
#include "proto/record/reader.hpp"
#include "scene/text/text.hpp"
#include "tests/support/device/scripted_hand.hpp"
#include "tests/unit/peer/core/pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace hapnet::lab::records {

/// The limits of an Omni, as far as they matter in a session.
[[nodiscard]] inline device::GovernorLimits limits_of_recorded_pair()
{
    return {.speed_max_m_per_s = 1.0};
}

/// The configuration of the peer that keeps the record, as its daemon writes it.
[[nodiscard]] inline nlohmann::json config_of(const peer::Settings& settings)
{
    return {{"peer_id", settings.introduction.id},
            {"nonce", settings.introduction.nonce},
            {"seed", settings.introduction.seed},
            {"tick_ns", 1'000'000},
            {"duration_s", base::to_seconds(settings.length)},
            {"grip_damping_ns_per_m", settings.grip_damping_ns_per_m},
            {"task", "T3"},
            {"mount", {{"offset_m", {0.0, 0.0, 0.0}}, {"scale", 1.0}}},
            {"governor_toml", device::print_limits(limits_of_recorded_pair())},
            {"scene_toml", scene::to_text(settings.scene)},
            {"algorithm_toml", peer::print_algorithm(settings.algorithm)}};
}

/// Two hands squeeze the cube and sway; side 0 keeps a record as its daemon does.
class RecordedPair {
public:
    /// Changes a sample of side 0's device in a tick, or the message of a watchdog to its governor.
    using Fate = std::function<void(int tick, device::Sample& sample, device::Governor& governor)>;

    explicit RecordedPair(Fate fate = {}) : fate_{std::move(fate)}
    {
        record_.config = config_of(peer::settings_of(0));
    }

    /// Its device renders up to this stiffness stably, N/m. Call it before play().
    void render_at_most(double stiffness_max_n_per_m)
    {
        peer::Settings settings = peer::settings_of(0);
        settings.stiffness_max_n_per_m = stiffness_max_n_per_m;
        players_[0].side = std::make_unique<peer::Side>(settings);
        record_.config["stiffness_max_n_per_m"] = stiffness_max_n_per_m;
    }

    /// They play in this scene. Call it before play().
    void play_in(const scene::Description& scene)
    {
        for (const std::size_t side : {0U, 1U}) {
            peer::Settings settings = peer::settings_of(side);
            settings.scene = scene;
            settings.introduction.scene_hash = scene::hash(scene);
            players_[side].side = std::make_unique<peer::Side>(settings);
            if (side == 0) record_.config = config_of(settings);
        }
    }

    /// Limits the energy into its hand. Call it before play().
    void limit_energy(const device::EnergyLimits& limits)
    {
        device::GovernorLimits all = limits_of_recorded_pair();
        all.energy = limits;
        players_[0].rig = device::Rig{std::make_unique<device::ScriptedHand>(), all};
        record_.config["governor_toml"] = device::print_limits(all);
    }
    /// The machine stands still for this time before this tick. Call it before play().
    void stand_still(int tick, base::Duration duration)
    {
        stall_tick_ = tick;
        stall_ = duration;
    }
    [[nodiscard]] const device::Governor& governor() const { return players_[0].rig.governor(); }

    record::Record play(int ticks)
    {
        for (int i = 0; i < ticks; ++i) {
            now_ += std::chrono::milliseconds{1};
            if (i == stall_tick_) now_ += stall_;
            place_hands(i);
            const auto number = static_cast<std::uint64_t>(i);
            deliver(number);
            for (const std::size_t side : {0U, 1U}) {
                players_[side].side->step(now_, players_[side].rig);
                while (const auto datagram = players_[side].side->poll()) {
                    players_[1 - side].inbox.push_back(*datagram);
                }
            }
            const peer::Side& side = *players_[0].side;
            record_.ticks.push_back(side.row(number, {.due = now_}));
            if (peer::is_one_without_turning(side.peer().shared())) continue;
            for (const peer::SharedBody& body : side.peer().shared())
                record_.bodies.push_back(side.body_row(number, body));
        }
        return record_;
    }

private:
    struct Player {
        explicit Player(std::size_t number)
            : side{std::make_unique<peer::Side>(peer::settings_of(number))}
        {}

        std::unique_ptr<peer::Side> side;
        device::Rig rig{std::make_unique<device::ScriptedHand>(), limits_of_recorded_pair()};
        std::vector<wire::Datagram> inbox{};
    };

    [[nodiscard]] device::Sample& sample(std::size_t side)
    {
        return dynamic_cast<device::ScriptedHand&>(players_[side].rig.device()).sample;
    }

    void place_hands(int tick)
    {
        const double sway = 0.004 * std::sin(0.01 * tick);
        for (const std::size_t side : {0U, 1U}) {
            sample(side) = {};
            sample(side).velocity = {{0.04 * std::cos(0.01 * tick), 0.0, 0.0}};
            sample(side).sequence = static_cast<std::uint64_t>(tick) + 1;
        }
        sample(0).hip = peer::pushing(0.003 + sway).hip;
        sample(1).hip = {{0.022 + sway, 0.0, 0.0}};
        if (fate_) fate_(tick, sample(0), players_[0].rig.governor());
    }

    void deliver(std::uint64_t tick)
    {
        for (const std::size_t side : {0U, 1U}) {
            for (const wire::Datagram& datagram : std::exchange(players_[side].inbox, {})) {
                players_[side].side->on_datagram(datagram.bytes(), now_);
                if (side == 0) note(datagram, tick);
            }
        }
    }

    void note(const wire::Datagram& datagram, std::uint64_t tick)
    {
        record_.messages.push_back({.tick = tick,
                                    .received_at = now_,
                                    .bytes{datagram.bytes().begin(), datagram.bytes().end()}});
    }

    Fate fate_;
    int stall_tick_ = -1;
    base::Duration stall_{};
    base::TimePoint now_{std::chrono::hours{1}};
    std::array<Player, 2> players_{Player{0}, Player{1}};
    record::Record record_;
};

} // namespace hapnet::lab::records

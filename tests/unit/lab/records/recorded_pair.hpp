// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/governor.hpp"
#include "device/governor/limits_text.hpp"
#include "peer/core/sync/text.hpp"
#include "proto/record/reader.hpp"
#include "scene/text/text.hpp"
#include "tests/unit/peer/core/pair.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace hapnet::lab {

/// Those of an Omni, as far as a session can meet them.
[[nodiscard]] inline device::GovernorLimits limits_of_recorded_pair()
{
    return {.speed_max_m_per_s = 1.0};
}

/// Of the peer that keeps the record: as its daemon writes it.
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
    /// Changes what the device of side 0 says in a tick, or what a watchdog tells its governor.
    using Fate = std::function<void(int tick, device::Sample& sample, device::Governor& governor)>;

    explicit RecordedPair(Fate fate = {}) : fate_{std::move(fate)}
    {
        record_.config = config_of(peer::settings_of(0));
    }

    /// Its device is stable up to this stiffness, N/m. Before play().
    void render_at_most(double stiffness_max_n_per_m)
    {
        peer::Settings settings = peer::settings_of(0);
        settings.stiffness_max_n_per_m = stiffness_max_n_per_m;
        pair_.start(0, settings);
        record_.config["stiffness_max_n_per_m"] = stiffness_max_n_per_m;
    }

    record::Record play(int ticks)
    {
        for (int i = 0; i < ticks; ++i) {
            const double sway = 0.004 * std::sin(0.01 * i);
            const base::Velocity speed{{0.04 * std::cos(0.01 * i), 0.0, 0.0}};
            device::Sample sample;
            sample.hip = peer::pushing(0.003 + sway).hip;
            sample.velocity = speed;
            sample.sequence = static_cast<std::uint64_t>(i) + 1;
            if (fate_) fate_(i, sample, governor_);
            pair_.hands[0] = {sample.hip, sample.velocity, sample.gripping, is_in_hand(sample)};
            pair_.hands[1] = {.hip = {{0.022 + sway, 0.0, 0.0}}, .velocity = speed};
            note_messages(static_cast<std::uint64_t>(i));
            pair_.step();
            note_tick(static_cast<std::uint64_t>(i), sample);
        }
        return record_;
    }

private:
    void note_messages(std::uint64_t tick)
    {
        for (const wire::Message& message : pair_.sent[1]) {
            const auto datagram = wire::encode(message);
            record::MessageRow row{.tick = tick,
                                   .received_at = pair_.now + std::chrono::milliseconds{1},
                                   .size = static_cast<std::uint16_t>(datagram.bytes().size())};
            std::ranges::copy(datagram.bytes(), row.bytes.begin());
            record_.messages.push_back(row);
        }
    }

    void note_tick(std::uint64_t tick, const device::Sample& sample)
    {
        const peer::Tick& played = pair_.ticks[0];
        record::TickRow row;
        row.tick = tick;
        row.due = pair_.now;
        row.phase = played.phase == peer::Phase::running ? record::Phase::running
                                                         : record::Phase::countdown;
        row.hip = sample.hip;
        row.hip_velocity = sample.velocity;
        row.gripping = sample.gripping;
        row.docked = sample.docked;
        row.calibrated = sample.calibrated;
        row.buttons = sample.buttons;
        row.fault = static_cast<std::uint8_t>(sample.fault);
        row.presses = sample.presses;
        row.sample_sequence = static_cast<std::uint16_t>(sample.sequence);
        row.contact = played.force;
        row.device = governor_.govern({row.contact, played.permitted}, sample, pair_.now).force();
        row.governor = static_cast<std::uint8_t>(governor_.state());
        record_.ticks.push_back(row);
    }

    Fate fate_;
    peer::Pair pair_;
    device::Governor governor_{limits_of_recorded_pair()};
    record::Record record_;
};

} // namespace hapnet::lab

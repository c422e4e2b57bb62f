// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/peer.hpp"

#include <array>
#include <chrono>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace hapnet::peer {

using namespace std::chrono_literals;

/// Side 0 is id 1, side 1 is id 2.
[[nodiscard]] inline Settings settings_of(std::size_t side, std::uint32_t run = 0)
{
    Settings settings;
    settings.introduction.id = static_cast<std::uint16_t>(side + 1);
    settings.introduction.nonce = static_cast<std::uint32_t>(1000 * (side + 1) + run);
    settings.introduction.scene_hash = hash(settings.scene);
    settings.introduction.task = wire::TaskName::from_text("T3").value();
    settings.length = 20s;
    return settings;
}

/// Two peers whose messages arrive in the next tick, and hands that stay where they are put.
class Pair {
public:
    Pair()
    {
        start(0, settings_of(0));
        start(1, settings_of(1));
    }

    void start(std::size_t side, const Settings& settings)
    {
        peers[side] = std::make_unique<Peer>(settings);
    }
    void kill(std::size_t side) { peers[side].reset(); }

    void step()
    {
        now += 1ms;
        for (const std::size_t side : {0U, 1U}) {
            for (const auto& datagram : std::exchange(inboxes_[side], {})) {
                if (peers[side]) peers[side]->on_datagram(datagram.bytes(), now);
            }
        }
        for (const std::size_t side : {0U, 1U}) {
            if (!peers[side]) continue;
            ticks[side] = peers[side]->tick(now, hands[side]);
            sent[side].clear();
            while (const auto datagram = peers[side]->poll()) {
                if (!cut) inboxes_[1 - side].push_back(*datagram);
                sent[side].push_back(wire::decode(datagram->bytes()).value());
            }
            while (const auto notice = peers[side]->notice()) events[side].push_back(notice->event);
        }
    }

    void run_for(base::Duration duration)
    {
        for (const auto end = now + duration; now < end;) step();
    }

    /// Plays until both run, which takes a second and a few ticks.
    void run_until_started()
    {
        const auto plays = [this](std::size_t side) {
            return ticks[side].phase == Phase::running && ticks[side].freshness > 0.0;
        };
        for (int ms = 0; ms < 3000 && !(plays(0) && plays(1)); ++ms) step();
        EXPECT_TRUE(plays(0) && plays(1));
    }

    /// Returns the state among a side's last messages.
    [[nodiscard]] std::optional<wire::State> state_sent_by(std::size_t side) const
    {
        for (const wire::Message& message : sent[side]) {
            if (const auto* state = std::get_if<wire::State>(&message)) return *state;
        }
        return std::nullopt;
    }

    [[nodiscard]] bool told(std::size_t side, Event event) const
    {
        return std::find(events[side].begin(), events[side].end(), event) != events[side].end();
    }

    base::TimePoint now{1h};
    std::array<std::unique_ptr<Peer>, 2> peers;
    std::array<Hand, 2> hands{Hand{.hip = {{-0.05, 0.0, 0.0}}, .velocity = {}},
                              Hand{.hip = {{0.05, 0.0, 0.0}}, .velocity = {}}};
    std::array<Tick, 2> ticks;
    std::array<std::vector<wire::Message>, 2> sent;
    std::array<std::vector<Event>, 2> events;
    bool cut = false;

private:
    std::array<std::vector<wire::Datagram>, 2> inboxes_;
};

/// A hand from the left whose HIP overlaps the cube at the origin by `depth` metres.
[[nodiscard]] inline Hand pushing(double depth)
{
    return {.hip = {{-0.025 + depth, 0.0, 0.0}}, .velocity = {}};
}

} // namespace hapnet::peer

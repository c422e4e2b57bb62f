// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/core/sync/situation.hpp"
#include "tests/support/session/fresh.hpp"

#include <chrono>
#include <optional>

namespace hapnet::peer {

using namespace std::chrono_literals;

inline constexpr base::TimePoint start{1h};
inline constexpr double force_max = 3.3;
inline constexpr scene::HandInput away{.present = false};

[[nodiscard]] inline scene::World paper_world()
{
    return scene::World::freeze(scene::paper_scene()).value();
}

/// A hand from the left, at this depth in the cube at the origin: 2 mm are 1 N.
[[nodiscard]] inline scene::HandInput pushing_hip(double depth)
{
    return {.position = {{-0.025 + depth, 0.0, 0.0}}};
}

/// A message as the tests write it: millimetres, and milliseconds of the sender's clock.
struct Word {
    std::uint32_t sequence = 1;
    double sent_ms = 0.0;
    double body_mm = 0.0;
    double speed_m_per_s = 0.0;
    bool touching = true;
    double force_n = 0.0;
    double hip_mm = 0.0;
    bool has_body = true;
};

[[nodiscard]] inline base::TimePoint at_ms(double ms)
{
    return start + base::from_seconds(1e-3 * ms);
}

/// A copy of the scene, the other side's messages, and the algorithm between them.
template <typename Algorithm>
class Copy {
public:
    explicit Copy(const Algorithm& value, Stale stale = Stale::drop)
        : algorithm{value}, remote{{.stale = stale}}
    {}

    void hear(const Word& word, double arrived_ms)
    {
        wire::State state;
        state.sequence = word.sequence;
        state.sent = at_ms(word.sent_ms);
        state.touching = word.touching;
        state.contact_force = {{word.force_n, 0.0, 0.0}};
        state.hip = {{1e-3 * word.hip_mm, 0.0, 0.0}};
        if (word.has_body) {
            wire::BodyState& body = state.bodies.add(wire::BodyState{});
            body.position = {{1e-3 * word.body_mm, 0.0, 0.0}};
            body.velocity = {{word.speed_m_per_s, 0.0, 0.0}};
        }
        const bool taken = remote.update(state, at_ms(arrived_ms));
        algorithm.hear({.state = state,
                        .arrived = at_ms(arrived_ms),
                        .taken = taken,
                        .clock = RemoteClock{clock},
                        .force_max_n = force_max,
                        .start = start});
    }

    Outcome tick(double now_ms, const scene::HandInput& hand = away, double freshness = 1.0)
    {
        world.set_hand(own_hand, hand);
        look_when_fresh_by(freshness, remote);
        return algorithm.tick(world, {.now = at_ms(now_ms),
                                      .others = {&remote, 1},
                                      .remote = remote,
                                      .yields = yields,
                                      .clock = RemoteClock{clock},
                                      .force_max_n = force_max,
                                      .lower_ids = lower_ids,
                                      .start = start,
                                      .number = number++});
    }
    [[nodiscard]] double x_mm() const { return 1e3 * world.body(0).position.x(); }
    [[nodiscard]] double speed() const { return world.body(0).velocity.x(); }

    Algorithm algorithm;
    Remote remote;
    scene::World world = paper_world();
    bool yields = true;
    std::size_t lower_ids = 0;
    std::int64_t number = 0; // of the next tick
    std::optional<ClockEstimate> clock = ClockEstimate{};
};

/// Plays a tick without the other side, apart from a push along x.
inline void tick(scene::World& world, const scene::HandInput& hand, double push_x = 0.0)
{
    world.set_hand(own_hand, hand);
    world.push(0, {{push_x, 0.0, 0.0}});
    world.tick();
}

} // namespace hapnet::peer

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/random.hpp"
#include "scene/collide/pair_finder.hpp"

#include <utility>
#include <vector>

namespace hapnet::scene {

/// Bodies and their neighbours, without a tick that moves them: the tests move them.
template <BroadPhase broad_phase>
struct Crowd {
    explicit Crowd(const Description& description)
        : config{description.planes, description.hands, description.gravity},
          bodies{description},
          pair_finder{config, bodies}
    {}

    /// Puts a body elsewhere.
    void place(BodyId id, const glm::dvec3& position)
    {
        bodies.position.put(bodies.slot_of[id], position);
    }
    void sleep(BodyId id)
    {
        const Slot from = bodies.slot_of[id];
        bodies.put_to_sleep(from);
        pair_finder.on_sleep(bodies, id, from);
        pair_finder.apply_changes();
    }
    void wake(BodyId id)
    {
        bodies.wake(bodies.slot_of[id]);
        pair_finder.on_wake(bodies, id);
        pair_finder.apply_changes();
    }
    [[nodiscard]] std::vector<std::pair<BodyId, BodyId>> pairs()
    {
        std::vector<std::pair<BodyId, BodyId>> all;
        for (const PairIndex i : pair_finder.pairs())
            all.emplace_back(pair_finder.pair(i).a, pair_finder.pair(i).b);
        return all;
    }
    [[nodiscard]] std::vector<std::pair<BodyId, BodyId>> plane_pairs()
    {
        std::vector<std::pair<BodyId, BodyId>> all;
        for (const PairIndex i : pair_finder.plane_pairs())
            all.emplace_back(pair_finder.plane_pair(i).a, pair_finder.plane_pair(i).b);
        return all;
    }

    WorldConfig config;
    Bodies bodies;
    PairFinder<broad_phase> pair_finder;
};

/// Movable cubes with edges of 4 cm, in a row along x, with this distance between centres.
inline Description row_of_cubes(std::size_t count, double distance_m)
{
    Description description;
    for (std::size_t i = 0; i < count; ++i) {
        BodyDescription cube;
        cube.position = base::Position{{static_cast<double>(i) * distance_m, 0.0, 0.0}};
        description.bodies.push_back(cube);
    }
    return description;
}

} // namespace hapnet::scene

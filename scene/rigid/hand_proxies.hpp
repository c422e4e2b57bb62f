// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/hand/friction.hpp"
#include "scene/state.hpp"

namespace hapnet::scene {

/// The points where hands stick: a proxy for each hand and body or plane that it rubs against. A
/// proxy is kept as a point of the body and a point of the hand's sphere, which does not turn; they
/// were together when it began, and what they are apart now, along the surface, stretches the
/// spring. So nothing drifts while it sticks, and a body that rolls under a hand slides by nothing.
class HandProxies {
public:
    explicit HandProxies(const WorldConfig& config);

    /// The place where a hand touches, seen from the centre of a body, or from the origin with a
    /// plane.
    struct Touch {
        std::uint32_t hand = 0;
        std::uint32_t other = 0; // a part of a body, or planes_from and a plane's index on
        glm::dmat3 axes{1.0};
        glm::dvec3 centre{0.0}; // of the hand's sphere
        glm::dvec3 point{0.0};  // of the surface
        glm::dvec3 normal{0.0};
        bool overlaps = false; // at the start of the tick
    };
    static constexpr std::uint32_t planes_from = bodies_max * (parts_max + 1);

    /// Starts a tick without any; those that the last one had not are dropped.
    void begin_step();
    /// The friction with which the tick begins.
    [[nodiscard]] FrictionSpring begin(const Touch& touch, const HandFriction& limits);
    /// Keeps the new state of the friction.
    void end(const Touch& touch, const FrictionSpring& friction);
    void forget(PartId part);

private:
    struct Proxy {
        std::uint32_t hand = 0;
        std::uint32_t other = 0;
        bool is_current = false;
        bool slides = false;
        glm::dvec3 at{0.0};     // on the body, in its frame
        glm::dvec3 offset{0.0}; // of the point of the sphere from its centre
    };
    [[nodiscard]] Proxy* find(const Touch& touch);

    Bounded<Proxy> proxies_;
};

} // namespace hapnet::scene

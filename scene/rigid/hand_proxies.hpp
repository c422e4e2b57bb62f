// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"
#include "scene/hand/friction.hpp"
#include "scene/state.hpp"

namespace hapnet::scene {

/// The points where hands stick: a proxy for each hand and each body or plane that it rubs against.
/// A proxy is stored as a point of the body and a point of the hand's sphere, which does not turn.
/// The two points coincided when the contact began. Their present distance along the surface
/// stretches the spring. So nothing drifts while the hand sticks, and a body that rolls under a
/// hand does not slide.
class HandProxies {
public:
    explicit HandProxies(const WorldConfig& config);

    /// The place where a hand touches, relative to the centre of a body, or to the origin for a
    /// plane.
    struct Touch {
        std::uint32_t hand = 0;
        std::uint32_t other = 0; // a PartId, or planes_from plus the index of a plane
        glm::dmat3 axes{1.0};
        glm::dvec3 centre{0.0}; // centre of the hand's sphere
        glm::dvec3 point{0.0};  // touching point of the surface
        glm::dvec3 normal{0.0};
        bool overlaps = false; // the hand overlaps the surface at the start of the tick
    };
    static constexpr std::uint32_t planes_from = bodies_max * (parts_max + 1);

    /// Starts a tick: drops the proxies that the last tick did not use.
    void begin_step();
    /// Returns the friction with which the tick begins.
    [[nodiscard]] FrictionSpring begin(const Touch& touch, const HandFriction& limits);
    /// Stores the new state of the friction.
    void end(const Touch& touch, const FrictionSpring& friction);
    void forget(PartId part);

private:
    struct Proxy {
        std::uint32_t hand = 0;
        std::uint32_t other = 0;
        bool is_current = false;
        bool slides = false;
        glm::dvec3 at{0.0};     // point of the body, in the body's frame
        glm::dvec3 offset{0.0}; // from the sphere's centre to the point of the sphere
    };
    [[nodiscard]] Proxy* find(const Touch& touch);

    Bounded<Proxy> proxies_;
};

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/collide/distance.hpp"
#include "scene/world.hpp"

#include <limits>
#include <optional>
#include <span>

namespace hapnet::scene {

// Queries about a world between two ticks. They do not change the world or allocate memory. All
// except contacts_of() visit every body: for 100 000 bodies that takes milliseconds.

/// A body, by its id, or a plane, by its place in the description.
struct Thing {
    enum class Kind : std::uint8_t { body, plane };
    Kind kind = Kind::body;
    std::uint32_t index = 0;

    friend bool operator==(const Thing&, const Thing&) = default;
};

/// A contact of two bodies, or of a body and a plane, that touch now or pushed each other in the
/// last tick. Each part of a body counts separately.
struct Contact {
    BodyId body = 0;
    Thing other;
    base::Position at{};         // the middle of the points that touch
    glm::dvec3 normal{0.0};      // unit, from `other` to `body`
    double separation = 0.0;     // m, at the deepest point; < 0: overlap
    double normal_impulse = 0.0; // N s, on `body` in the last tick; for a sleeping body in each
                                 // tick
};

/// Lists the contacts of all bodies, each once, with the body of the lower id as `body`. They are
/// sorted by the bodies' ids; those with planes come last. Writes as many contacts as `room` holds,
/// and returns how many there are. A box that cannot turn may push several obstacles on one side:
/// then they share the impulse equally.
std::size_t contacts(const World& world, std::span<Contact> room);
/// As contacts(), for one body.
std::size_t contacts_of(const World& world, BodyId body, std::span<Contact> room);

/// A ray from `origin` along `direction`, which may have any length but zero.
struct Ray {
    base::Position origin{};
    glm::dvec3 direction{1.0, 0.0, 0.0};
    double length_max_m = std::numeric_limits<double>::infinity();
};
struct RayHit {
    Thing what;
    double distance_m = 0.0;
    base::Position at{};
    glm::dvec3 normal{0.0}; // normal of the surface; against the ray if it began inside
};
/// Returns the first body or plane that a ray meets. Of several at the same distance it is the
/// first in the description, bodies before planes. A ray that begins inside a body meets it at
/// distance 0. nullopt when the ray meets nothing or is not finite.
[[nodiscard]] std::optional<RayHit> cast_ray(const World& world, const Ray& ray);

/// Returns the distance of a point from a body; < 0: inside.
[[nodiscard]] Separation separation(const World& world, const base::Position& point, BodyId body);
/// Returns the distance of two bodies; < 0: minus the shortest way that moves them apart.
[[nodiscard]] Separation separation(const World& world, BodyId first, BodyId second);

struct NearestBody {
    BodyId body = 0;
    Separation separation{}; // between the point and that body
};
/// Returns the body with the least separation from a point; nullopt in a scene without bodies.
[[nodiscard]] std::optional<NearestBody> nearest_body(const World& world,
                                                      const base::Position& point);

/// Lists the bodies that a sphere touches or overlaps, sorted by their ids. Writes as many as
/// `room` holds, and returns how many there are.
std::size_t bodies_in_sphere(const World& world, const base::Position& centre, double radius_m,
                             std::span<BodyId> room);

} // namespace hapnet::scene

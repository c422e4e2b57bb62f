// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"
#include "scene/mass.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace hapnet::scene {

/// A body's index in its description.
using BodyId = std::uint32_t;

/// A rigid body's place and motion.
struct BodyState {
    base::Position position{};
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    base::Velocity velocity{};
    glm::dvec3 angular_velocity{0.0}; // rad/s, in the world's frame
};

/// The id of a body's part. The first part has the id of its body. Further parts have ids after
/// those of all bodies.
using PartId = std::uint32_t;

/// Where a body lies in the lanes. It changes when the body falls asleep or wakes; its id does not.
using Slot = std::uint32_t;

/// The properties of a body that never change. They are the cold half of its data.
struct BodyProperties {
    BodyId id = 0;
    glm::dvec3 half{0.02};    // half the edges of the box, or of the box around the shape, m
    double least_half = 0.02; // the smallest half edge of the body's parts, m
    double rounding = 0.0;    // how far a round body's surface is from its core, m
    PartId parts_begin = 0;   // first id of its further parts, if any: see Bodies::parts
    PartId parts_end = 0;
    glm::dvec3 inverse_mass{0.0};    // 1/kg per axis of the world; 0 where locked or fixed
    glm::dvec3 inertia{1.0};         // kg m^2 about the body's own axes
    glm::dvec3 inverse_inertia{0.0}; // 0 where the body cannot rotate; with one free axis see
                                     // `turning`
    double mass = 0.0;               // kg; 0: fixed
    Turning turning = Turning::locked;
    bool is_kinematic = false; // not pushed, but it moves: angular_momentum holds its angular
                               // velocity
    bool is_isotropic = false; // the three moments of inertia are equal, as a cube's
    Material material{};
    double drag = 0.0; // N s/m

    [[nodiscard]] bool has_parts() const { return parts_begin != parts_end; }
};

/// Returns the angular impulse without its parts about axes that the body cannot turn about.
[[nodiscard]] inline glm::dvec3 about_unlocked_axes(const BodyProperties& properties,
                                                    const glm::dvec3& angular)
{
    if (properties.turning == Turning::free) return angular;
    return {properties.inverse_inertia.x > 0.0 ? angular.x : 0.0,
            properties.inverse_inertia.y > 0.0 ? angular.y : 0.0,
            properties.inverse_inertia.z > 0.0 ? angular.z : 0.0};
}

/// True if the body starts to roll when friction stops its slip.
[[nodiscard]] inline bool rolls(const BodyProperties& body)
{
    return body.rounding > 0.0 && body.turning != Turning::locked;
}

/// The state of all bodies. The hot half lies in lanes: each lane holds one number of every body,
/// one body after the other. So a loop over many bodies reads only what it needs, and compilers can
/// vectorise it. Slots are kept in ranges: awake [0, awake), asleep [awake, movable), kinematic
/// [movable, moving), fixed [moving, size). The state is the angular momentum about the centre
/// (world's frame) and not the angular velocity, as a free body keeps its angular momentum.
struct Bodies {
    struct Lanes3 {
        std::vector<double> x, y, z;
        [[nodiscard]] glm::dvec3 at(Slot i) const { return {x[i], y[i], z[i]}; }
        void put(Slot i, const glm::dvec3& v)
        {
            x[i] = v.x;
            y[i] = v.y;
            z[i] = v.z;
        }
    };
    struct Lanes4 {
        std::vector<double> w, x, y, z;
        [[nodiscard]] glm::dquat at(Slot i) const { return {w[i], x[i], y[i], z[i]}; }
        void put(Slot i, const glm::dquat& q)
        {
            w[i] = q.w;
            x[i] = q.x;
            y[i] = q.y;
            z[i] = q.z;
        }
    };

    Lanes3 position;                         // centres of mass, m
    Lanes3 velocity;                         // m/s
    Lanes4 orientation;                      // unit
    Lanes3 angular_momentum;                 // kg m^2/s
    std::vector<double> inverse_inertia_max; // the largest inverse moment of inertia, 1/(kg m^2)
    std::vector<BodyProperties> properties;
    std::vector<Slot> slot_of;   // by PartId: a further part has the slot of its body
    std::vector<BodyPart> parts; // by PartId; empty if every body has one part, its own box

    Slot awake = 0;
    Slot movable = 0;
    Slot moving = 0;

    /// Makes all movable bodies awake. The slots have the order of the ids: first the movable
    /// bodies, then the kinematic and the fixed ones.
    explicit Bodies(const Description& description);

    [[nodiscard]] Slot size() const { return static_cast<Slot>(properties.size()); }
    [[nodiscard]] PartId parts_count() const { return static_cast<PartId>(slot_of.size()); }
    /// Returns the number of parts of the movable bodies.
    [[nodiscard]] PartId movable_parts() const
    {
        const auto further = std::count_if(slot_of.begin() + size(), slot_of.end(),
                                           [this](Slot slot) { return slot < movable; });
        return movable + static_cast<PartId>(further);
    }
    [[nodiscard]] BodyId body_of(PartId part) const
    {
        return part < size() ? part : properties[slot_of[part]].id;
    }
    /// Calls visit(part) for each part of a body, in the order of their ids.
    template <typename Visit>
    void for_parts(BodyId body, Visit visit) const
    {
        visit(PartId{body});
        if (parts.empty()) return;
        const BodyProperties& its = properties[slot_of[body]];
        for (PartId part = its.parts_begin; part < its.parts_end; ++part) visit(part);
    }
    [[nodiscard]] bool any_is_round() const;

    /// Exchanges two bodies' slots.
    void swap(Slot a, Slot b);
    /// Moves a body over the border between awake and asleep. Returns its new slot.
    Slot put_to_sleep(Slot slot);
    Slot wake(Slot slot);

    /// Returns the inverse inertia times a vector, in the world's frame.
    [[nodiscard]] glm::dvec3 apply_inverse_inertia(Slot slot, const glm::dvec3& momentum) const
    {
        const BodyProperties& body = properties[slot];
        return responds_alike(body) ? body.inverse_inertia * momentum
                                    : turned_inverse_inertia(body, orientation.at(slot), momentum);
    }
    /// Returns the angular velocity that belongs to an angular momentum of a body with this
    /// orientation.
    [[nodiscard]] static glm::dvec3 apply_inverse_inertia(const BodyProperties& body,
                                                          const glm::dquat& orientation,
                                                          const glm::dvec3& momentum)
    {
        return responds_alike(body) ? body.inverse_inertia * momentum
                                    : turned_inverse_inertia(body, orientation, momentum);
    }
    [[nodiscard]] glm::dvec3 angular_velocity(Slot slot) const
    {
        return apply_inverse_inertia(slot, angular_momentum.at(slot));
    }
    /// Returns the kinetic energy of translation and rotation, J.
    [[nodiscard]] double kinetic_energy(Slot slot) const;
    /// Returns the angular momentum that belongs to an angular velocity of a body with this
    /// orientation.
    [[nodiscard]] static glm::dvec3 apply_inertia(const BodyProperties& body,
                                                  const glm::dquat& orientation,
                                                  const glm::dvec3& angular_velocity);
    /// Sets the angular momentum of a body to the one that belongs to this angular velocity, rad/s.
    void set_angular_velocity(Slot slot, const glm::dvec3& angular_velocity);

    [[nodiscard]] BodyState state(Slot slot) const;
    void put(Slot slot, const BodyState& state);

private:
    void add_parts(const Description& description);
    /// True if the body responds equally about every axis, or does not turn freely. Then its
    /// response needs no change of frame.
    [[nodiscard]] static bool responds_alike(const BodyProperties& body)
    {
        return body.is_isotropic || body.turning != Turning::free;
    }
    [[nodiscard]] static glm::dvec3 turned_inverse_inertia(const BodyProperties& body,
                                                           const glm::dquat& orientation,
                                                           const glm::dvec3& momentum);
};

} // namespace hapnet::scene

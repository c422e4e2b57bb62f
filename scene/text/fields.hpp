// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"
#include "scene/description.hpp"
#include "scene/text/formats.hpp"

namespace hapnet::scene {

// The keys of a scene's text, by which it is read and printed: docs/formats/scene.md. They stand
// here and not beside their structs, so that a stepper does not read formats of TOML.

constexpr auto fields_of(base::Tag<Material>)
{
    return base::fields("material",
                        base::field("friction", &Material::friction,
                                    base::Number{0.0, friction_max},
                                    "Coulomb's coefficient; a pair has the geometric mean"),
                        base::field("restitution", &Material::restitution, base::Number{0.0, 1.0},
                                    "0: no bounce, 1: elastic; a pair has the greater one"));
}

constexpr auto fields_of(base::Tag<HandDescription>)
{
    return base::fields(
        "hips",
        base::field("count", &HandDescription::count, base::Count{0, hands_max}, "number of hands")
            .always(),
        base::field("radius", &HandDescription::radius_m,
                    base::Quantity{base::length_kind, size_min_m, size_max_m}, "of each sphere")
            .always(),
        base::field("stiffness", &HandDescription::stiffness_n_per_m,
                    base::Quantity{base::stiffness_kind, 0.0, stiffness_max_n_per_m},
                    "of the spring between sphere and body")
            .always(),
        base::field("damping", &HandDescription::damping_ns_per_m,
                    base::Quantity{base::damping_kind, 0.0, damping_max_ns_per_m},
                    "of the damper between sphere and body")
            .always(),
        base::field("force_max", &HandDescription::force_max_n, text::ForceLimit{},
                    "limit of one contact")
            .always(),
        base::field("grip_reach", &HandDescription::grip_reach_m,
                    base::Quantity{base::length_kind, 0.0, size_max_m},
                    "distance to the surface within which a hand can take hold")
            .always(),
        base::field("friction", &HandDescription::friction, base::Number{0.0, friction_max},
                    "Coulomb's coefficient of a finger, applied by the session"));
}

constexpr auto fields_of(base::Tag<PlaneDescription>)
{
    return base::fields(
        "plane", base::field("name", &PlaneDescription::name),
        base::field("normal", &PlaneDescription::normal, text::Direction{}, "out of the solid side")
            .always(),
        base::field("offset", &PlaneDescription::offset_m,
                    base::Quantity{base::length_kind, -reach_max_m, reach_max_m},
                    "distance from the origin along the normal")
            .always(),
        base::part(&PlaneDescription::material));
}

constexpr auto fields_of(base::Tag<BodyDescription>)
{
    constexpr text::PerAxis place{{base::length_kind, -reach_max_m, reach_max_m}};
    constexpr text::PerAxis speed{{base::speed_kind, -speed_max_m_per_s, speed_max_m_per_s}};
    constexpr text::PerAxis turn{{base::turn_kind, -turn_max_rad_per_s, turn_max_rad_per_s}};
    return base::fields(
        "body", base::field("name", &BodyDescription::name),
        base::field("fixed", &BodyDescription::movable, text::Fixed{}, "nothing moves it"),
        base::field("size", &BodyDescription::half, text::Edges{}, "its edges").always(),
        base::field("position", &BodyDescription::position, place, "of its centre").always(),
        base::field("orientation", &BodyDescription::orientation, text::Orientation{}),
        base::field("velocity", &BodyDescription::velocity, speed),
        base::field("angular_velocity", &BodyDescription::angular_velocity, turn,
                    "in the world's frame"),
        base::field("mass", &BodyDescription::mass_kg,
                    base::Quantity{base::mass_kind, mass_min_kg, mass_max_kg},
                    "or `density`; a body that is not fixed has one of them")
            .if_set(&BodyDescription::movable),
        base::field("turning", &BodyDescription::turning, "how it may rotate"),
        base::field("locked", &BodyDescription::locked, text::Axes{},
                    "axes along which it does not move"),
        base::part(&BodyDescription::material),
        base::field("drag", &BodyDescription::drag_ns_per_m,
                    base::Quantity{base::damping_kind, 0.0, damping_max_ns_per_m},
                    "viscous friction on the plane that supports it"));
}

constexpr auto fields_of(base::Tag<Description>)
{
    constexpr text::PerAxis gravity{
        {base::acceleration_kind, -gravity_max_m_per_s2, gravity_max_m_per_s2}};
    return base::fields("scene", base::field("name", &Description::name),
                        base::field("gravity", &Description::gravity, gravity).always());
}

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "scene/description.hpp"
#include "scene/text/formats.hpp"

#include <optional>

namespace hapnet::scene {

// The keys of a scene's text, for reading and printing: docs/formats/scene.md. They are here and
// not beside their structs, so that steppers do not depend on the formats of TOML.

constexpr auto fields_of(base::Tag<Material>)
{
    return base::fields(
        "material",
        base::field("friction", &Material::friction, base::Number{0.0, friction_max},
                    "Coulomb's coefficient; a contact of two bodies has the geometric mean"),
        base::field("restitution", &Material::restitution, base::Number{0.0, 1.0},
                    "0: no bounce, 1: elastic; a contact of two bodies has the greater value"));
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
                    "limit of the force of one contact")
            .always(),
        base::field("grip_reach", &HandDescription::grip_reach_m,
                    base::Quantity{base::length_kind, 0.0, size_max_m},
                    "distance from the surface within which a hand takes hold")
            .always(),
        base::field("friction", &HandDescription::friction, base::Number{0.0, friction_max},
                    "Coulomb's coefficient between finger and body, in a session"),
        base::field("static_friction", &HandDescription::static_friction,
                    base::Number{0.0, friction_max},
                    "Coulomb's coefficient of a hand that sticks; with a surface the geometric "
                    "mean"),
        base::field("dynamic_friction", &HandDescription::dynamic_friction,
                    base::Number{0.0, friction_max},
                    "of a hand that slides, at most the above; unset: the same"));
}

constexpr auto fields_of(base::Tag<FieldDescription>)
{
    constexpr text::PerAxis place{{base::length_kind, -reach_max_m, reach_max_m}};
    constexpr text::PerAxis force{{base::force_kind, -force_max_n, force_max_n}};
    return base::fields(
        "field", base::field("name", &FieldDescription::name, "for readers"),
        base::field("position", &FieldDescription::position, place,
                    "the middle of the region, and where the spring pulls to")
            .always(),
        base::field("size", &FieldDescription::half, text::Edges{},
                    "the edges of the region; without it the field is everywhere"),
        base::field("force", &FieldDescription::force, force, "constant"),
        base::field("damping", &FieldDescription::damping_ns_per_m,
                    base::Quantity{base::damping_kind, 0.0, damping_max_ns_per_m},
                    "against the velocity"),
        base::field("stiffness", &FieldDescription::stiffness_n_per_m,
                    base::Quantity{base::stiffness_kind, 0.0, stiffness_max_n_per_m},
                    "of a spring to the position, or to the line through it"),
        base::field("line", &FieldDescription::line, text::Direction{},
                    "along which the spring does not pull"),
        base::field("force_max", &FieldDescription::force_limit_n, text::ForceLimit{},
                    "limit of the field's force"),
        base::field("hands", &FieldDescription::on_hands, base::Flag{}, "whether hands feel it"),
        base::field("bodies", &FieldDescription::on_bodies, base::Flag{},
                    "whether it acts on movable bodies"));
}

constexpr auto fields_of(base::Tag<PlaneDescription>)
{
    return base::fields("plane", base::field("name", &PlaneDescription::name, "for readers"),
                        base::field("normal", &PlaneDescription::normal, text::Direction{},
                                    "out of the solid side; of any length")
                            .always(),
                        base::field("offset", &PlaneDescription::offset_m,
                                    base::Quantity{base::length_kind, -reach_max_m, reach_max_m},
                                    "distance of the surface from the origin along the normal")
                            .always(),
                        base::part(&PlaneDescription::material),
                        base::field("felt", &PlaneDescription::felt, base::Flag{},
                                    "hands feel it as they feel bodies"));
}

constexpr auto fields_of(base::Tag<Feel>)
{
    return base::fields(
        "hand",
        base::field("stiffness", &Feel::stiffness_n_per_m,
                    base::Quantity{base::stiffness_kind, 0.0, stiffness_max_n_per_m},
                    "of the spring of a hand, instead of that of `[hips]`"),
        base::field("damping", &Feel::damping_ns_per_m,
                    base::Quantity{base::damping_kind, 0.0, damping_max_ns_per_m},
                    "of the damper of a hand, instead of that of `[hips]`"),
        base::field("static_friction", &Feel::static_friction, base::Number{0.0, friction_max},
                    "of a hand that sticks, instead of that of `[hips]`, or of a body to hands, "
                    "instead of its `friction`"),
        base::field("dynamic_friction", &Feel::dynamic_friction, base::Number{0.0, friction_max},
                    "of a hand that slides, likewise; at most the above"));
}

constexpr auto fields_of(base::Tag<Sway>)
{
    return base::fields(
        "sway",
        base::field("sway", &Sway::by,
                    text::PerAxis{{base::length_kind, -reach_max_m, reach_max_m}},
                    "how far a kinematic body goes from its position, and back, over and over"),
        base::field("sway_period", &Sway::period, base::Time{base::Duration{}, period_max},
                    "how long it takes there and back, 10 ms at least"));
}

constexpr auto fields_of(base::Tag<PartDescription>)
{
    constexpr text::PerAxis place{{base::length_kind, -size_max_m, size_max_m}};
    return base::fields("part", base::field("shape", &PartDescription::shape, "as of a body"),
                        base::field("size", &PartDescription::half, text::Edges{},
                                    "the edges, or those of the box around it")
                            .required(),
                        base::field("position", &PartDescription::position, place,
                                    "of its centre, seen from the centre of the body's first part")
                            .always(),
                        base::field("orientation", &PartDescription::orientation,
                                    text::Orientation{}, "in the frame of the body's first part"));
}

constexpr auto fields_of(base::Tag<BodyDescription>)
{
    constexpr text::PerAxis place{{base::length_kind, -reach_max_m, reach_max_m}};
    constexpr text::PerAxis speed{{base::speed_kind, -speed_max_m_per_s, speed_max_m_per_s}};
    constexpr text::PerAxis turn{{base::turn_kind, -turn_max_rad_per_s, turn_max_rad_per_s}};
    return base::fields(
        "body", base::field("name", &BodyDescription::name, "for readers"),
        base::field("fixed", &BodyDescription::movable, text::Fixed{},
                    "it never moves; its mass, velocities, drag and locks are then ignored"),
        base::field("kinematic", &BodyDescription::kinematic, base::Flag{},
                    "it moves with its velocities, or as it sways, whatever it pushes; it needs no "
                    "mass and counts as fixed"),
        base::field("shape", &BodyDescription::shape,
                    "a sphere's edges are equal; two of a capsule's, which lies along the third"),
        base::field("size", &BodyDescription::half, text::Edges{},
                    "the edges, or those of the box around it")
            .required(),
        base::field("position", &BodyDescription::position, place, "of the centre").always(),
        base::field("orientation", &BodyDescription::orientation, text::Orientation{},
                    "a quaternion may have any length"),
        base::field("velocity", &BodyDescription::velocity, speed, "of the centre"),
        base::field("angular_velocity", &BodyDescription::angular_velocity, turn,
                    "about the axes of the world"),
        base::part(&BodyDescription::sway),
        base::field("mass", &BodyDescription::mass_kg,
                    base::Quantity{base::mass_kind, mass_min_kg, mass_max_kg},
                    "required unless the body is fixed or has a `density`")
            .if_set(&BodyDescription::movable),
        base::field("turning", &BodyDescription::turning,
                    "how it may rotate: freely, not at all, or about one axis of the world"),
        base::field("locked", &BodyDescription::locked, text::Axes{},
                    "axes along which the centre cannot move"),
        base::part(&BodyDescription::material),
        base::field("drag", &BodyDescription::drag_ns_per_m,
                    base::Quantity{base::damping_kind, 0.0, damping_max_ns_per_m},
                    "viscous friction on the plane below it"),
        base::part(&BodyDescription::feel));
}

namespace text {

/// The density that may be written instead of a mass.
struct Density {
    std::optional<double> kg_per_m3{};
};
constexpr auto fields_of(base::Tag<Density>)
{
    // The density range spans the smallest and the largest mass.
    return base::fields("density", base::field("density", &Density::kg_per_m3,
                                               base::Quantity{base::density_kind, 1e-9, 1e18},
                                               "instead of `mass`"));
}

/// The number of equal bodies along each axis, and their spacing.
struct Array {
    Counts::Value count{1, 1, 1};
    glm::dvec3 spacing{0.0};
};
constexpr auto fields_of(base::Tag<Array>)
{
    constexpr PerAxis spacing{{base::length_kind, -reach_max_m, reach_max_m}};
    return base::fields(
        "array",
        base::field("count", &Array::count, Counts{}, "number of bodies along x, y and z")
            .required(),
        base::field("spacing", &Array::spacing, spacing, "from the centre of one to the next")
            .required());
}

} // namespace text

constexpr auto fields_of(base::Tag<Description>)
{
    constexpr text::PerAxis gravity{
        {base::acceleration_kind, -gravity_max_m_per_s2, gravity_max_m_per_s2}};
    return base::fields(
        "scene",
        base::field("name", &Description::name, "for readers; two peers need not agree on it"),
        base::field("gravity", &Description::gravity, gravity, "acceleration of all movable bodies")
            .always());
}

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/requirements.hpp"

#include "proto/base/ensure.hpp"
#include "scene/state.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::scene {

namespace {

// The number of bodies above which a grid finds neighbours faster than a scan of all: about 64 to
// 80, measured with packed boxes.
constexpr std::size_t scan_max = 64;

/// The counts that the reasons name.
struct Census {
    std::size_t movable = 0;
    std::size_t fixed = 0;
    std::size_t kinematic = 0;   // number of the fixed bodies that are kinematic
    std::size_t round = 0;       // spheres and capsules
    std::size_t own_feel = 0;    // bodies and hands with a stiffness or damping of their own
    std::size_t felt_planes = 0; // planes that hands feel
    std::size_t turning = 0;     // movable bodies that can rotate
    std::size_t skew = 0;        // boxes and planes not parallel to the axes
    std::size_t compound = 0;    // bodies of several parts
    std::size_t bouncing = 0;    // bodies and planes with restitution
    std::size_t rough = 0;       // movable bodies with friction
    std::size_t rough_other = 0; // fixed bodies and planes with friction
    std::size_t dragged = 0;     // movable bodies with viscous friction
    bool has_flush = false;      // some fixed boxes lie flush
};

bool is_parallel(const glm::dquat& q) { return q.x == 0.0 && q.y == 0.0 && q.z == 0.0; }

bool is_parallel(const glm::dvec3& normal)
{
    const auto is_zero = [](double v) { return v == 0.0; };
    return int{is_zero(normal.x)} + int{is_zero(normal.y)} + int{is_zero(normal.z)} == 2;
}

/// True if hands may feel seams between fixed boxes.
bool has_flush(const Description& description, const Census& census)
{
    if (census.fixed < 2 || description.hands.count == 0) return false;
    return InternalFaces{Bodies{description}}.any();
}

Census census_of(const Description& description)
{
    Census census;
    for (const BodyDescription& body : description.bodies) {
        ++(body.movable ? census.movable : census.fixed);
        if (body.kinematic) ++census.kinematic;
        const auto is_round = [](const auto& part) { return part.shape != Shape::box; };
        if (is_round(body) || std::any_of(body.parts.begin(), body.parts.end(), is_round))
            ++census.round;
        if (!body.parts.empty()) ++census.compound;
        if (body.feel.is_own()) ++census.own_feel;
        if (body.movable && body.turning != Turning::locked) ++census.turning;
        if (!is_parallel(body.orientation)) ++census.skew;
        if (body.material.restitution > 0.0) ++census.bouncing;
        if (body.material.friction > 0.0) ++(body.movable ? census.rough : census.rough_other);
        if (body.movable && body.drag_ns_per_m > 0.0) ++census.dragged;
    }
    for (const Feel& hand : description.own_hands) {
        if (hand.is_own()) ++census.own_feel;
    }
    for (const PlaneDescription& plane : description.planes) {
        if (plane.felt) ++census.felt_planes;
        if (!is_parallel(plane.normal)) ++census.skew;
        if (plane.material.restitution > 0.0) ++census.bouncing;
        if (plane.material.friction > 0.0) ++census.rough_other;
    }
    census.has_flush = has_flush(description, census);
    return census;
}

Requirement require(Feature feature, bool needed, std::string because)
{
    return {feature, needed, std::move(because)};
}

Requirement require_friction(const Census& census)
{
    if (census.rough == 0) return require(Feature::friction, false, "no movable body is rough");
    if (census.rough_other == 0 && census.rough < 2) {
        return require(Feature::friction, false, "a rough body meets nothing that is rough");
    }
    return require(Feature::friction, true,
                   fmt::format("{} of {} movable bodies are rough", census.rough, census.movable));
}

Requirement require_hand_friction(const Description& description)
{
    if (has_hand_friction(description)) {
        return require(Feature::hand_friction, true, "rough hands meet rough bodies or planes");
    }
    return require(Feature::hand_friction, false, "no hand has friction on anything");
}

Requirement require_contact(const Description& description, const Census& census)
{
    const bool are_felt = description.hands.count > 0 && census.fixed > 0;
    if (census.movable == 0 && !are_felt)
        return require(Feature::contact, false, "nothing is movable");
    const std::size_t others = census.movable - std::min<std::size_t>(census.movable, 1) +
                               census.fixed + description.planes.size() + description.hands.count;
    if (others == 0) {
        return require(Feature::contact, false, "one movable body with nothing around it");
    }
    return require(Feature::contact, true,
                   fmt::format("movable bodies: {}; fixed bodies: {}; planes: {}; hands: {}",
                               census.movable, census.fixed, description.planes.size(),
                               description.hands.count));
}

/// Where nothing is movable, the steppers whose hands feel planes also make them feel fixed bodies.
Requirement require_felt_planes(const Description& description, const Census& census)
{
    if (census.movable == 0 && census.fixed > 0 && description.hands.count > 0) {
        return require(
            Feature::felt_planes, true,
            fmt::format("nothing is movable, and hands feel fixed bodies: {}", census.fixed));
    }
    return require(Feature::felt_planes, census.felt_planes > 0 && description.hands.count > 0,
                   fmt::format("planes that hands feel: {}; hands: {}", census.felt_planes,
                               description.hands.count));
}

/// Fixed boxes that lie flush are one solid.
Requirement require_compounds(const Census& census, std::size_t total)
{
    if (census.compound == 0 && census.has_flush)
        return require(Feature::compounds, true, "fixed boxes lie flush");
    return require(Feature::compounds, census.compound > 0,
                   fmt::format("bodies of several parts: {} of {}", census.compound, total));
}

Requirement without_contact(Feature feature)
{
    return require(feature, false, "nothing touches anything");
}

} // namespace

std::string_view name_of(Feature feature)
{
    constexpr std::array<std::string_view, features> names{
        "contact",     "hips",   "skew",          "rotation", "friction",  "restitution",
        "drag",        "bodies", "sleep",         "grid",     "kinematic", "feel",
        "felt-planes", "fields", "hand-friction", "shapes",   "compounds"};
    return names.at(static_cast<std::size_t>(feature));
}

std::string_view name_of(StepperKind kind)
{
    constexpr std::array<std::string_view, stepper_kinds> names{
        "flight", "sliding", "sliding-coulomb", "lone", "few", "many"};
    return names.at(static_cast<std::size_t>(kind));
}

FeatureSet abilities_of(StepperKind kind)
{
    using enum Feature;
    FeatureSet set;
    const auto add = [&set](auto... those) { (set.add(those), ...); };
    switch (kind) {
    case StepperKind::flight: add(rotation, skew, fields, shapes, compounds); break;
    case StepperKind::many: add(grid); [[fallthrough]];
    case StepperKind::few: add(bodies); [[fallthrough]];
    case StepperKind::lone:
        add(sleep, rotation, skew, kinematic, feel, felt_planes, hand_friction, shapes, compounds);
        [[fallthrough]];
    case StepperKind::sliding_coulomb: add(friction); [[fallthrough]];
    case StepperKind::sliding: add(contact, hands, restitution, drag, fields); break;
    }
    return set;
}

Requirements requirements_of(const Description& description, bool sleeping)
{
    using enum Feature;
    const Census census = census_of(description);
    const std::size_t total = census.movable + census.fixed;
    Requirements needs{
        require_contact(description, census),
        require(hands, description.hands.count > 0,
                fmt::format("hands: {}", description.hands.count)),
        require(skew, census.skew > 0,
                fmt::format("boxes and planes not parallel to the axes: {}", census.skew)),
        require(
            rotation, census.turning > 0,
            fmt::format("movable bodies that can turn: {} of {}", census.turning, census.movable)),
        require_friction(census),
        require(restitution, census.bouncing > 0,
                fmt::format("bodies and planes that make things bounce: {}", census.bouncing)),
        require(drag, census.dragged > 0 && !description.planes.empty(),
                fmt::format("movable bodies with drag: {}; planes: {}", census.dragged,
                            description.planes.size())),
        require(bodies, census.movable > 1, fmt::format("movable bodies: {}", census.movable)),
        require(sleep, sleeping && census.movable > 1,
                sleeping ? fmt::format("movable bodies: {}", census.movable)
                         : std::string{"switched off"}),
        require(grid, total > scan_max && census.movable > 0,
                fmt::format("bodies: {}; up to {} a scan is faster", total, scan_max)),
        require(kinematic, census.kinematic > 0,
                fmt::format("bodies that move by themselves: {}", census.kinematic)),
        require(feel, census.own_feel > 0 && description.hands.count > 0,
                fmt::format("bodies and hands with a spring of their own: {}; hands: {}",
                            census.own_feel, description.hands.count)),
        require_felt_planes(description, census),
        require(fields, !description.fields.empty(),
                fmt::format("fields of force: {}", description.fields.size())),
        require_hand_friction(description),
        require(shapes, census.round > 0,
                fmt::format("spheres and capsules: {} of {} bodies", census.round, total)),
        require_compounds(census, total)};
    if (!needs[0].is_required) {
        for (Requirement& each : needs) {
            const bool is_own = each.feature == contact || each.feature == rotation ||
                                each.feature == kinematic || each.feature == felt_planes ||
                                each.feature == fields || each.feature == hand_friction ||
                                each.feature == shapes || each.feature == compounds;
            if (!is_own) each = without_contact(each.feature);
        }
    }
    return needs;
}

FeatureSet required_features(const Requirements& needs)
{
    FeatureSet set;
    for (const Requirement& each : needs) {
        if (each.is_required) set.add(each.feature);
    }
    return set;
}

StepperKind cheapest_stepper(FeatureSet needed)
{
    for (std::size_t i = 0; i < stepper_kinds; ++i) {
        const auto kind = static_cast<StepperKind>(i);
        if (abilities_of(kind).covers(needed)) return kind;
    }
    base::ensure(false); // the last one can do everything
    return StepperKind::many;
}

} // namespace hapnet::scene

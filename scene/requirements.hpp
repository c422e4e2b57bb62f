// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/description.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace hapnet::scene {

/// A feature that a scene may require of its stepper.
enum class Feature : std::uint8_t {
    contact, // anything can touch anything at all
    hands,
    skew,          // a box or a plane that is not parallel to the axes
    rotation,      // a movable body that can rotate
    friction,      // Coulomb friction
    restitution,   // bounces
    drag,          // viscous friction
    bodies,        // movable bodies that can touch each other
    sleep,         // bodies at rest cost nothing
    grid,          // too many bodies to compare each with all others
    kinematic,     // bodies that move by themselves
    feel,          // bodies or hands with a stiffness or damping of their own
    felt_planes,   // planes that hands feel
    fields,        // fields of force
    hand_friction, // hands that stick and slide
    shapes,        // spheres and capsules
    compounds,     // bodies of several parts
};
inline constexpr std::size_t features = 17;

[[nodiscard]] std::string_view name_of(Feature feature);

/// A set of features.
class FeatureSet {
public:
    constexpr FeatureSet() = default;
    template <typename... Features>
    constexpr explicit FeatureSet(Features... those) : bits_{(0U | ... | bit(those))}
    {}
    [[nodiscard]] constexpr bool has(Feature feature) const { return (bits_ & bit(feature)) != 0; }
    constexpr void add(Feature feature) { bits_ |= bit(feature); }
    /// True if this set has everything that `needed` has.
    [[nodiscard]] constexpr bool covers(FeatureSet needed) const
    {
        return (needed.bits_ & ~bits_) == 0;
    }
    friend constexpr bool operator==(FeatureSet, FeatureSet) = default;

private:
    static constexpr std::uint32_t bit(Feature feature)
    {
        return 1U << static_cast<unsigned>(feature);
    }
    std::uint32_t bits_ = 0;
};

/// The steppers, the cheapest first. Each is compiled for its features alone, without a branch for
/// the others. Their printed names are a contract: `hapnet-lab explain` shows them.
enum class StepperKind : std::uint8_t {
    flight,  // nothing touches anything: exact parabolas and rotations
    sliding, // one box that cannot rotate among others parallel to it: exact, event by event
    sliding_coulomb, // as `sliding`, with dry friction
    lone,            // one movable body that can rotate
    few,             // movable bodies that touch each other; each is compared with all others
    many,            // as `few`, but pairs are found through a grid
};
inline constexpr std::size_t stepper_kinds = 6;

[[nodiscard]] std::string_view name_of(StepperKind kind);
/// Returns the features that a stepper supports.
[[nodiscard]] FeatureSet abilities_of(StepperKind kind);

/// The need of a scene for a feature: true or false, and why.
struct Requirement {
    Feature feature = Feature::contact;
    bool is_required = false;
    std::string because;
};

/// The requirements of a scene, feature by feature.
using Requirements = std::array<Requirement, features>;
[[nodiscard]] Requirements requirements_of(const Description& description, bool sleeping);
[[nodiscard]] FeatureSet required_features(const Requirements& needs);

/// Returns the cheapest stepper that has the required features.
[[nodiscard]] StepperKind cheapest_stepper(FeatureSet needed);

} // namespace hapnet::scene

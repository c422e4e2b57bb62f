// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/state.hpp"
#include "tests/bench/scene/translation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::bench {

using Hips = std::array<scene::HandInput, scene::hands_max>;

/// Hands before their first place is set.
[[nodiscard]] inline Hips absent_hips()
{
    Hips hands;
    for (scene::HandInput& hip : hands) hip.present = false;
    return hands;
}

/// A force and where it acts.
struct Load {
    glm::dvec3 force{0.0};
    glm::dvec3 point{0.0};
};

/// A hand's sphere in a surface: how deep, where, and which way it pushes.
struct Dent {
    double depth = 0.0; // 0: it does not touch
    glm::dvec3 point{0.0};
    glm::dvec3 normal{0.0};
    glm::dvec3 velocity{0.0}; // of the hand over the surface
};

/// The push of the hand's spring and damper on a surface, N.
[[nodiscard]] inline double push_of(const Dent& dent, const scene::HandDescription& hands)
{
    const double approach = glm::dot(dent.velocity, dent.normal);
    return std::clamp(hands.stiffness_n_per_m * dent.depth + hands.damping_ns_per_m * approach, 0.0,
                      hands.force_max_n);
}

/// Works also for a sphere whose centre is within the box.
[[nodiscard]] inline Dent dent_in(const scene::BodyState& body, const glm::dvec3& half,
                                  const scene::HandInput& hip, double radius_m)
{
    const glm::dvec3 local =
        glm::conjugate(body.orientation) * (hip.position.value - body.position.value);
    glm::dvec3 nearest = glm::clamp(local, -half, half);
    glm::dvec3 away = local - nearest; // from the surface to the sphere's centre
    const double distance = std::sqrt(glm::dot(away, away));
    double depth = radius_m - distance;
    if (depth <= 0.0) return {};
    if (distance > 0.0) {
        away /= distance;
    } else {
        const glm::dvec3 gap = half - glm::abs(local);
        const int axis = gap.x <= gap.y && gap.x <= gap.z ? 0 : gap.y <= gap.z ? 1 : 2;
        away = glm::dvec3{0.0};
        away[axis] = local[axis] < 0.0 ? -1.0 : 1.0;
        nearest[axis] = away[axis] * half[axis];
        depth = radius_m + gap[axis];
    }
    const glm::dvec3 arm = body.orientation * nearest;
    const glm::dvec3 velocity = body.velocity.value + glm::cross(body.angular_velocity, arm);
    return {depth, body.position.value + arm, body.orientation * -away,
            hip.velocity.value - velocity};
}

/// The hand's spring and damper on a box, from its state at one moment: what haptic libraries hold
/// for a step, and what the reference integrates.
[[nodiscard]] inline Load penalty(const scene::BodyState& body, const glm::dvec3& half,
                                  const scene::HandInput& hip, const scene::HandDescription& hands)
{
    if (!hip.present) return {};
    const Dent dent = dent_in(body, half, hip, hands.radius_m);
    if (dent.depth == 0.0) return {};
    return {push_of(dent, hands) * dent.normal, dent.point};
}

/// Hands for an engine that has none: forces from the state at a step's start, held for the step,
/// on the first body and on planes that hands feel. With friction, a second spring, with the same
/// stiffness and damping, connects each hand to a proxy on the body, as in CHAI3D.
class HeldHands {
public:
    explicit HeldHands(const Translation& all)
        : hands_{all.scene.hands}, friction_{all.hand_friction}
    {
        for (const auto& plane : all.scene.planes) {
            if (plane.felt) felt_.push_back(plane);
        }
        if (!all.solids.empty()) half_ = all.solids[0].parts[0].half;
    }

    void set(std::uint32_t index, const scene::HandInput& input) { hips_[index] = input; }
    [[nodiscard]] const Hips& hips() const { return hips_; }

    /// Returns the force of a hand on the first body.
    [[nodiscard]] Load on_body(std::uint32_t index, const scene::BodyState& body)
    {
        const scene::HandInput& hip = hips_[index];
        if (!friction_.is_rough()) return penalty(body, half_, hip, hands_);
        if (!hip.present) return {};
        const Dent dent = dent_in(body, half_, hip, hands_.radius_m);
        if (dent.depth == 0.0) {
            proxies_[index] = {};
            return {};
        }
        const double push = push_of(dent, hands_);
        return {push * dent.normal + pull(index, body, dent, push), dent.point};
    }

    /// Returns the force of a hand on the planes that hands feel.
    [[nodiscard]] glm::dvec3 on_planes(std::uint32_t index) const
    {
        glm::dvec3 force{0.0};
        const scene::HandInput& hip = hips_[index];
        for (const auto& plane : felt_) {
            const double height = glm::dot(hip.position.value, plane.normal) - plane.offset_m;
            const double depth = hands_.radius_m - height;
            if (!hip.present || depth <= 0.0) continue;
            force -= push_of({depth, {}, -plane.normal, hip.velocity.value}, hands_) * plane.normal;
        }
        return force;
    }

private:
    struct Proxy {
        bool is_set = false;
        bool slides = false;
        glm::dvec3 at{0.0}; // in the body's frame
    };

    /// Returns the pull along the surface. The proxy follows where the pull exceeds the friction.
    glm::dvec3 pull(std::uint32_t index, const scene::BodyState& body, const Dent& dent,
                    double push)
    {
        Proxy& proxy = proxies_[index];
        const auto to_body = [&](const glm::dvec3& point) {
            return glm::conjugate(body.orientation) * (point - body.position.value);
        };
        if (!proxy.is_set) proxy = {true, false, to_body(dent.point)};
        const auto along = [&](const glm::dvec3& v) {
            return v - glm::dot(v, dent.normal) * dent.normal;
        };
        const glm::dvec3 at = body.position.value + body.orientation * proxy.at;
        const glm::dvec3 stretch = along(dent.point - at);
        const glm::dvec3 force =
            hands_.stiffness_n_per_m * stretch + hands_.damping_ns_per_m * along(dent.velocity);
        const double size = glm::length(force);
        const double limit = (proxy.slides ? friction_.sliding : friction_.sticking) * push;
        proxy.slides = size > limit;
        if (!proxy.slides) return force;
        const double held = friction_.sliding * push;
        const double longest = held / hands_.stiffness_n_per_m;
        const double length = glm::length(stretch);
        if (length > longest) proxy.at = to_body(dent.point - longest / length * stretch);
        return held / size * force;
    }

    scene::HandDescription hands_;
    scene::HandFriction friction_;
    std::vector<scene::PlaneDescription> felt_;
    glm::dvec3 half_{0.0};
    Hips hips_ = absent_hips();
    std::array<Proxy, scene::hands_max> proxies_{};
};

/// The force of a scene's fields on a body at one moment, N. The fields have no bounds here.
[[nodiscard]] inline glm::dvec3 force_of_fields(const scene::Description& scene,
                                                const scene::BodyState& body)
{
    glm::dvec3 force{0.0};
    for (const auto& field : scene.fields) {
        if (!field.on_bodies) continue;
        glm::dvec3 out = body.position.value - field.position.value;
        if (field.line) out -= glm::dot(out, *field.line) * *field.line;
        force += field.force.value - field.damping_ns_per_m * body.velocity.value -
                 field.stiffness_n_per_m * out;
    }
    return force;
}

} // namespace hapnet::bench

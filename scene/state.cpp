// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/state.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace hapnet::scene {

namespace {

HandFriction friction_of_hand(const Description& description, std::uint32_t hand)
{
    const bool is_own = hand < description.own_hands.size();
    return friction_of(description.hands, is_own ? description.own_hands[hand] : Feel{});
}

} // namespace

bool has_hand_friction(const Description& description)
{
    bool any_hand = false;
    for (std::uint32_t hand = 0; hand < description.hands.count; ++hand)
        any_hand = any_hand || friction_of_hand(description, hand).is_rough();
    const auto is_rough_body = [](const BodyDescription& body) {
        return friction_of(body.material, body.feel).is_rough();
    };
    const auto is_rough_plane = [](const PlaneDescription& plane) {
        return plane.felt && friction_of(plane.material).is_rough();
    };
    const auto& [bodies, planes] = std::tie(description.bodies, description.planes);
    return any_hand && (std::any_of(bodies.begin(), bodies.end(), is_rough_body) ||
                        std::any_of(planes.begin(), planes.end(), is_rough_plane));
}

void HandFeels::set_friction(const Description& description)
{
    if (!has_hand_friction(description)) return;
    for (std::uint32_t hand = 0; hand < description.hands.count; ++hand)
        friction_of_hands_.push_back(friction_of_hand(description, hand));
    for (const BodyDescription& body : description.bodies)
        friction_of_bodies_.push_back(friction_of(body.material, body.feel));
    for (const PlaneDescription& plane : description.planes)
        friction_of_planes_.push_back(friction_of(plane.material));
}

HandFeels::HandFeels(const Description& description)
{
    set_friction(description);
    const auto is_own = [](const auto& each) { return each.feel.is_own(); };
    const std::vector<BodyDescription>& bodies = description.bodies;
    const bool any_hand = std::any_of(description.own_hands.begin(), description.own_hands.end(),
                                      [](const Feel& feel) { return feel.is_own(); });
    if (!any_hand && std::none_of(bodies.begin(), bodies.end(), is_own)) return;
    std::map<std::pair<double, double>, std::uint32_t> known;
    const auto kind_of = [&](const Feel& feel) {
        constexpr double unset = -1.0;
        const std::pair key{feel.stiffness_n_per_m.value_or(unset),
                            feel.damping_ns_per_m.value_or(unset)};
        const auto [found, is_new] =
            known.try_emplace(key, static_cast<std::uint32_t>(kinds_.size()));
        for (std::uint32_t hand = 0; is_new && hand < description.hands.count; ++hand) {
            const Feel own =
                hand < description.own_hands.size() ? description.own_hands[hand] : Feel{};
            kinds_.push_back(hand_on(description.hands, own, feel));
        }
        return found->second;
    };
    kind_of({}); // the first kind: for planes, and for all bodies without a feel of their own
    for (const BodyDescription& body : bodies) kind_of_.push_back(kind_of(body.feel));
}

Scales scales_of(const WorldConfig& config, const Bodies& bodies)
{
    double size = std::numeric_limits<double>::infinity();
    for (Slot slot = 0; slot < bodies.movable; ++slot)
        size = std::min(size, bodies.properties[slot].least_half);
    constexpr double hardly = 1e-6;
    const double fall = config.tick * std::sqrt(glm::dot(config.gravity, config.gravity));
    return {config.tick, size, fall, std::max(fall, hardly * size / config.tick),
            1.0 / config.tick};
}

} // namespace hapnet::scene

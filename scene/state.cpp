// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/state.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <utility>

namespace hapnet::scene {

HandFeels::HandFeels(const Description& description)
{
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
    kind_of({}); // the first: of planes, and of all bodies without a feel of their own
    for (const BodyDescription& body : bodies) kind_of_.push_back(kind_of(body.feel));
}

Scales scales_of(const WorldConfig& config, const Bodies& bodies)
{
    double size = std::numeric_limits<double>::infinity();
    double least = size;
    for (Slot slot = 0; slot < bodies.size(); ++slot) {
        const glm::dvec3& half = bodies.properties[slot].half;
        least = std::min(least, std::min(half.x, std::min(half.y, half.z)));
        if (slot < bodies.movable) size = least;
    }
    constexpr double hardly = 1e-6;
    const double fall = config.tick * std::sqrt(glm::dot(config.gravity, config.gravity));
    return {config.tick,      size, least, fall, std::max(fall, hardly * size / config.tick),
            1.0 / config.tick};
}

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/pressing_hands.hpp"

#include <algorithm>
#include <glm/geometric.hpp>

namespace hapnet::scene {

PressingHands::PressingHands(BodyId body, const Hand& a, const Hand& b)
    : body_{body},
      hand_{a.hand, b.hand},
      found_{both(a.face.offset, b.face.offset)},
      room_{a.face.room, b.face.room},
      half_{a.face.half, b.face.half}
{
    springs_.normal = both(a.face.normal, b.face.normal);
    springs_.radius = Two{a.spring.radius, b.spring.radius};
    springs_.stiffness = Two{a.spring.stiffness, b.spring.stiffness};
    springs_.damping = Two{a.spring.damping, b.spring.damping};
    springs_.force_max = Two{a.spring.force_max, b.spring.force_max};
    springs_.are_two = a.hand != b.hand;
}

bool PressingHands::is_where_it_was(std::uint32_t hand, const HandInput& input,
                                    std::span<const PartId> near) const
{
    if (hand == hand_[0] || hand == hand_[1])
        return !input.gripping && near.size() == 1 && near[0] == body_;
    return !input.gripping && near.empty();
}

std::optional<TwoVectors> PressingHands::press(const WorldState& state, const SweptBox& now,
                                               const glm::dvec3& velocity)
{
    const HandInput& a = state.hands[hand_[0]];
    const HandInput& b = state.hands[hand_[1]];
    const TwoVectors offset = both(a.position.value, b.position.value) - both(now.box.centre);
    const Two away = sum_of_sizes(offset - found_);
    if (!(away[0] <= room_[0] && away[1] <= room_[1])) return std::nullopt;
    const Two above = dot(springs_.normal, offset) - half_;
    springs_.arm = offset - above * springs_.normal;
    const Two gap = above - springs_.radius;
    springs_.gap = gap;
    const Two depth = -gap;
    if (!(depth[0] > 0.0 && depth[1] > 0.0 && depth[0] < springs_.radius[0] &&
          depth[1] < springs_.radius[1]))
        return std::nullopt;
    springs_.velocity = both(a.velocity.value, b.velocity.value);
    const TwoVectors here = both(velocity) + cross(both(now.spin), springs_.arm);
    const Two closing = dot(here - springs_.velocity, springs_.normal);
    // force_at() computes the same force for one hand.
    const Two wanted = springs_.stiffness * depth + springs_.damping * closing;
    const Two force{std::clamp(wanted[0], 0.0, springs_.force_max[0]),
                    std::clamp(wanted[1], 0.0, springs_.force_max[1])};
    depth_ = depth;
    at_start_ = force * springs_.normal;
    return offset;
}

void PressingHands::report(const WorldConfig& config, WorldState& state,
                           const TwoVectors& impulse) const
{
    const double rate = 1.0 / config.tick;
    const glm::dvec3 none{0.0};
    const auto report_one = [&](std::uint32_t hand, double depth, const glm::dvec3& at_start,
                                const glm::dvec3& on_body) {
        const base::Force force{rate * on_body};
        const bool pushes = glm::dot(force.value, force.value) > 0.0;
        state.touches[hand] = {.touching = pushes,
                               .body = pushes ? body_ : 0,
                               .on_body = pushes ? force : base::Force{},
                               .on_hand = base::Force{none - force.value},
                               .depth_m = depth,
                               .on_hand_at_start = base::Force{none + at_start}};
    };
    if (config.hands.count > 2 || !springs_.are_two)
        for (std::uint32_t i = 0; i < config.hands.count; ++i) state.touches[i] = {};
    report_one(hand_[0], depth_[0], first(at_start_), first(impulse));
    if (springs_.are_two) report_one(hand_[1], depth_[1], second(at_start_), second(impulse));
}

} // namespace hapnet::scene

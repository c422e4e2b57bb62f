// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/rigid/joint_order.hpp"

#include "scene/solver/islands.hpp"

#include <algorithm>
#include <utility>

namespace hapnet::scene {

namespace {

/// Calls join(a, b) for the movable bodies that one joint joins.
template <typename Join>
void for_joined(const Description& scene, Join join)
{
    for (const JointDescription& joint : scene.joints) {
        if (joint.to && scene.bodies[joint.body].movable && scene.bodies[*joint.to].movable)
            join(joint.body, *joint.to);
    }
}

/// The joints of one group, each next to those that share a body with it, breadth first: a chain
/// comes out from its end.
std::vector<JointId> breadth_first(const Description& scene, std::vector<JointId> left)
{
    const auto share = [&](JointId one, JointId other) {
        const JointDescription& p = scene.joints[one];
        const JointDescription& q = scene.joints[other];
        for (const std::uint32_t x : {p.body, p.to.value_or(p.body)}) {
            if (!scene.bodies[x].movable) continue;
            if (x == q.body || x == q.to.value_or(q.body)) return true;
        }
        return false;
    };
    const auto neighbours = [&](JointId id) {
        return std::count_if(left.begin(), left.end(),
                             [&](JointId other) { return other != id && share(id, other); });
    };
    const auto start = std::min_element(left.begin(), left.end(), [&](JointId a, JointId b) {
        return neighbours(a) < neighbours(b);
    });
    std::vector<JointId> order{*start};
    left.erase(start);
    for (std::size_t next = 0; next < order.size(); ++next) {
        const JointId from = order[next];
        const auto far = std::stable_partition(left.begin(), left.end(),
                                               [&](JointId id) { return share(from, id); });
        order.insert(order.end(), left.begin(), far);
        left.erase(left.begin(), far);
    }
    return order;
}

} // namespace

JointOrder joint_order(const Description& description)
{
    JointOrder order;
    const auto& bodies = description.bodies;
    const auto& joints = description.joints;
    if (joints.empty()) return order;
    Islands islands{bodies.size()};
    for (BodyId body = 0; body < bodies.size(); ++body) islands.reset(body);
    for_joined(description, [&](BodyId a, BodyId b) { islands.join(a, b); });
    const auto root_of = [&](JointId id) {
        return islands.root_of(bodies[joints[id].body].movable ? joints[id].body : *joints[id].to);
    };
    std::vector<bool> is_done(joints.size(), false);
    for (JointId id = 0; id < joints.size(); ++id) {
        if (is_done[id]) continue;
        std::vector<JointId> alike;
        for (JointId other = id; other < joints.size(); ++other) {
            if (root_of(other) != root_of(id)) continue;
            is_done[other] = true;
            alike.push_back(other);
        }
        const auto begin = static_cast<std::uint32_t>(order.ids.size());
        for (const JointId next : breadth_first(description, std::move(alike)))
            order.ids.push_back(next);
        order.groups.push_back({begin, static_cast<std::uint32_t>(order.ids.size())});
    }
    const auto movable_in = [&](JointId id, BodyId body) {
        return bodies[body].movable && (joints[id].body == body || joints[id].to == body);
    };
    for (std::uint32_t i = 0; i < order.ids.size(); ++i) {
        const JointDescription& joint = joints[order.ids[i]];
        std::uint32_t first = i;
        for (std::uint32_t j = 0; j < i; ++j) {
            const bool is_near = movable_in(order.ids[j], joint.body) ||
                                 (joint.to && movable_in(order.ids[j], *joint.to));
            if (is_near) {
                first = j;
                break;
            }
        }
        order.first.push_back(first);
    }
    return order;
}

std::vector<BodyPair> joined_apart(const Description& description)
{
    std::vector<BodyPair> pairs;
    for (const JointDescription& joint : description.joints) {
        if (joint.collides || !joint.to) continue;
        pairs.emplace_back(std::min(joint.body, *joint.to), std::max(joint.body, *joint.to));
    }
    std::sort(pairs.begin(), pairs.end());
    return pairs;
}

JointSolver joint_solver_of(const Description& description)
{
    JointOrder order = joint_order(description);
    return {std::move(order.groups), std::move(order.first)};
}

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/control/scene_report.hpp"

#include "peer/core/shared_body.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer {

namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
Json turn_json(const glm::dquat& q) { return {q.w, q.x, q.y, q.z}; }

/// Returns a description of a body or one of its parts.
Json solid_json(const auto& solid)
{
    return {{"shape", base::name_of(solid.shape)},
            {"half", vector_json(solid.half)},
            {"position", vector_json(solid.position.value)},
            {"orientation", turn_json(solid.orientation)}};
}

Json body_json(const scene::Description& scene, std::size_t id, bool is_shared)
{
    const scene::BodyDescription& body = scene.bodies[id];
    Json out{{"body", id}, {"name", body.name}};
    out.update(solid_json(body));
    out["movable"] = body.movable;
    out["shared"] = is_shared;
    out["turns"] = body.movable && body.turning != scene::Turning::locked;
    out["colour"] = body.movable ? "blue" : "pink"; // as in the paper's figure
    for (const scene::PartDescription& part : body.parts) out["parts"].push_back(solid_json(part));
    return out;
}

} // namespace

nlohmann::ordered_json scene_json(const scene::Description& scene)
{
    const auto shared = shared_bodies(scene);
    Json bodies = Json::array();
    const std::size_t shown = std::min(scene.bodies.size(), bodies_shown_max);
    for (std::size_t id = 0; id < shown; ++id) {
        const bool is_shared = shared && std::ranges::any_of(*shared, [&](const SharedBody& one) {
                                   return one.id == id;
                               });
        bodies.push_back(body_json(scene, id, is_shared));
    }
    Json planes = Json::array();
    for (const scene::PlaneDescription& plane : scene.planes) {
        planes.push_back({{"name", plane.name},
                          {"normal", vector_json(plane.normal)},
                          {"offset", plane.offset_m}});
    }
    Json out{{"name", scene.name},
             {"hash", fmt::format("{:016x}", scene::hash(scene))},
             {"bodies", std::move(bodies)},
             {"hips", {{"radius", scene.hands.radius_m}, {"count", scene.hands.count}}},
             {"planes", std::move(planes)}};
    if (shown < scene.bodies.size()) out["bodies_left_out"] = scene.bodies.size() - shown;
    return out;
}

} // namespace hapnet::peer

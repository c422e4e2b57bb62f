// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/replays.hpp"
#include "proto/page/base64.hpp"
#include "scene/description.hpp"
#include "scene/mass.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::report {

namespace {

using page::Json;

constexpr double mm_per_m = 1e3;

/// Packs a column as 16 bits per value, low byte first, with the value of one step. A constant
/// column becomes one number.
Json packed(const std::vector<double>& column)
{
    double most = 0.0;
    bool moves = false;
    for (const double value : column) {
        most = std::max(most, std::abs(value));
        moves |= value != column.front();
    }
    if (!moves) return column.front();
    const double step = most / 32767.0;
    std::string bytes;
    for (const double value : column) {
        const auto count = static_cast<std::int16_t>(std::lround(value / step));
        const auto bits = static_cast<std::uint16_t>(count);
        bytes += static_cast<char>(bits & 0xffU);
        bytes += static_cast<char>(bits >> 8U);
    }
    return {{"step", step}, {"data", page::base64(bytes)}};
}

Json json_of(const glm::dvec3& mm) { return {mm.x, mm.y, mm.z}; }
Json json_of(const glm::dquat& q) { return {q.w, q.x, q.y, q.z}; }

/// Describes the parts of a body, in the frame of its mass, in mm. For a rounded part `half` is
/// that of the box within it.
Json parts_of_body(const scene::BodyDescription& body)
{
    Json parts = Json::array();
    for (const scene::BodyPart& part : scene::parts_of(body)) {
        const glm::dvec3 inner = part.half - glm::dvec3{part.rounding};
        const bool is_round = part.rounding > 0.0;
        parts.push_back({{"at", json_of(mm_per_m * part.at)},
                         {"q", json_of(glm::quat_cast(part.axes))},
                         {"half", json_of(mm_per_m * (is_round ? inner : part.half))},
                         {"rounding", mm_per_m * part.rounding}});
    }
    return parts;
}

/// Returns the bodies of a scene.
Json bodies_of(const scene::Description& scene)
{
    Json list = Json::array();
    for (const scene::BodyDescription& body : scene.bodies) {
        const scene::MassFrame frame = scene::frame_of_mass(body);
        list.push_back({{"name", body.name},
                        {"movable", body.movable},
                        {"turns", body.movable && body.turning != scene::Turning::locked},
                        {"parts", parts_of_body(body)},
                        {"at", json_of(mm_per_m * frame.centre.value)},
                        {"q", json_of(frame.orientation)}});
    }
    return list;
}

/// Returns the height of the platform, in mm; where a scene has no level plane, the height of the
/// paper's.
double floor_of(const scene::Description& scene)
{
    for (const scene::PlaneDescription& plane : scene.planes)
        if (plane.normal.y > 0.99) return mm_per_m * plane.offset_m;
    return -20.0;
}

/// Calls packed() for the column of one number of each value.
template <typename Value, typename Number>
Json packed_column(const std::vector<Value>& values, const Number& number)
{
    std::vector<double> column;
    column.reserve(values.size());
    for (const Value& value : values) column.push_back(number(value));
    return packed(column);
}

Json packed(const std::vector<glm::dvec3>& values)
{
    Json columns;
    for (const auto& [name, axis] : {std::pair{"x", 0}, {"y", 1}, {"z", 2}})
        columns[name] =
            packed_column(values, [axis = axis](const glm::dvec3& v) { return v[axis]; });
    return columns;
}

Json packed(const std::vector<virtual_time::Pose>& poses, bool turns)
{
    std::vector<glm::dvec3> places;
    for (const virtual_time::Pose& pose : poses) places.push_back(mm_per_m * pose.position.value);
    Json columns = packed(places);
    if (!turns) return columns;
    const auto add = [&](const char* name, double glm::dquat::*part) {
        columns[name] = packed_column(
            poses, [part](const virtual_time::Pose& pose) { return pose.orientation.*part; });
    };
    add("qw", &glm::dquat::w);
    add("qx", &glm::dquat::x);
    add("qy", &glm::dquat::y);
    add("qz", &glm::dquat::z);
    return columns;
}

bool can_turn(const scene::Description& scene, std::size_t body)
{
    return body < scene.bodies.size() && scene.bodies[body].turning != scene::Turning::locked;
}

Json packed(const results::Replay& replay)
{
    Json sides = Json::array();
    for (const results::ReplaySide& side : replay.sides) {
        Json bodies = Json::array();
        for (std::size_t i = 0; i < side.bodies.size(); ++i)
            bodies.push_back(packed(side.bodies[i], can_turn(replay.scene, replay.shared[i])));
        sides.push_back({{"name", side.name},
                         {"left", side.is_left},
                         {"hand", packed(side.hand_mm)},
                         {"force", packed(side.force_n)},
                         {"bodies", std::move(bodies)}});
    }
    return {
        {"algorithm", replay.algorithm},     {"task", replay.task},
        {"bodies", bodies_of(replay.scene)}, {"shared", replay.shared},
        {"floor", floor_of(replay.scene)},   {"hip_radius", mm_per_m * replay.scene.hands.radius_m},
        {"start_s", replay.start_s},         {"step_s", replay.step_s},
        {"count", replay.steps()},           {"sides", std::move(sides)}};
}

} // namespace

page::Json replays_of(const results::Results& results)
{
    Json replays = Json::array();
    for (const results::Replay& replay : results.replays) replays.push_back(packed(replay));
    return replays;
}

} // namespace hapnet::lab::report

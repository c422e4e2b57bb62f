// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/text/text.hpp"
#include "scene/text/values.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <spdlog/fmt/fmt.h>
#include <tuple>
#include <utility>

namespace hapnet::scene {

namespace {

using base::Node;
using base::Place;
using base::Reading;
using base::TableReader;
using text::read;
using text::Span;

constexpr std::size_t scene_bytes_max = 64U << 20U; // of the most bodies, each on its own

constexpr Span place_span{base::length_kind, -reach_max_m, reach_max_m};
constexpr Span size_span{base::length_kind, 2.0 * size_min_m, 2.0 * size_max_m};
constexpr Span radius_span{base::length_kind, size_min_m, size_max_m};
constexpr Span reach_span{base::length_kind, 0.0, size_max_m};
constexpr Span speed_span{base::speed_kind, -speed_max_m_per_s, speed_max_m_per_s};
constexpr Span turn_span{base::turn_kind, -turn_max_rad_per_s, turn_max_rad_per_s};
constexpr Span mass_span{base::mass_kind, mass_min_kg, mass_max_kg};
constexpr Span density_span{base::density_kind, 1e-9, 1e18}; // of the smallest, the largest mass
constexpr Span drag_span{base::damping_kind, 0.0, damping_max_ns_per_m};
constexpr Span stiffness_span{base::stiffness_kind, 0.0, stiffness_max_n_per_m};
constexpr Span force_span{base::force_kind, 0.0, force_max_n};
constexpr Span gravity_span{base::acceleration_kind, -gravity_max_m_per_s2, gravity_max_m_per_s2};

/// Calls `use` with the value of a key, if it is there.
template <typename Use>
void with(TableReader& table, std::string_view key, Use use)
{
    if (const Node* node = table.find(key)) use(*node);
}

void read_material(TableReader& table, Material& material)
{
    Reading& reading = table.reading();
    with(table, "friction", [&](const Node& node) {
        text::read_share(node, material.friction, friction_max, reading);
    });
    with(table, "restitution",
         [&](const Node& node) { text::read_share(node, material.restitution, 1.0, reading); });
}

/// What is written as a mass or as a density.
void read_mass(TableReader& table, BodyDescription& body)
{
    Reading& reading = table.reading();
    const Node* mass = table.find("mass");
    const Node* density = table.find("density");
    if (mass != nullptr && density != nullptr) {
        return reading.complain(density->place, "the mass says it already: leave out one of them");
    }
    if (mass != nullptr) return read(*mass, body.mass_kg, mass_span, reading);
    if (density == nullptr) return;
    double value = 1.0;
    read(*density, value, density_span, reading);
    const double kg = value * 8.0 * body.half.x * body.half.y * body.half.z;
    if (!(kg >= mass_min_kg && kg <= mass_max_kg)) {
        return reading.complain(density->place,
                                fmt::format("makes a mass of {:.3g} kg: from {} to {} is possible",
                                            kg, base::quantity_text(mass_min_kg, base::mass_kind),
                                            base::quantity_text(mass_max_kg, base::mass_kind)));
    }
    body.mass_kg = kg;
}

/// The keys that a body and an array of bodies have in common.
BodyDescription read_body_keys(TableReader& table)
{
    Reading& reading = table.reading();
    BodyDescription body;
    with(table, "name", [&](const Node& node) { base::read_value(node, body.name, reading); });
    bool is_fixed = false;
    with(table, "fixed", [&](const Node& node) { read(node, is_fixed, reading); });
    body.movable = !is_fixed;
    with(table, "size", [&](const Node& node) {
        glm::dvec3 edges = 2.0 * body.half;
        text::read_size(node, edges, size_span, reading);
        body.half = 0.5 * edges;
    });
    const auto read_three = [&](std::string_view key, glm::dvec3& target, const Span& span) {
        with(table, key, [&](const Node& node) { read(node, target, span, reading); });
    };
    read_three("position", body.position.value, place_span);
    with(table, "orientation",
         [&](const Node& node) { text::read_orientation(node, body.orientation, reading); });
    read_three("velocity", body.velocity.value, speed_span);
    read_three("angular_velocity", body.angular_velocity, turn_span);
    read_mass(table, body);
    with(table, "turning", [&](const Node& node) { read(node, body.turning, reading); });
    with(table, "locked", [&](const Node& node) { text::read_locked(node, body, reading); });
    read_material(table, body.material);
    with(table, "drag",
         [&](const Node& node) { read(node, body.drag_ns_per_m, drag_span, reading); });
    return body;
}

/// To be called once all other keys are known: a misspelt one is the better complaint.
void require_body_keys(TableReader& table, bool is_movable)
{
    std::ignore = table.require("size");
    if (!is_movable || table.find("mass") != nullptr || table.find("density") != nullptr) return;
    table.reading().complain(table.place(), "'mass' or 'density' is missing here: a body that is "
                                            "not fixed has one, such as mass = \"100g\"");
}

/// A scene that grows body by body, and where each stands in the text.
struct Growing {
    Description scene;
    std::vector<Place> body_places;
    std::vector<Place> plane_places;
};

/// How many bodies an array has along each axis; all 1 when that is complained of.
std::array<std::uint32_t, 3> read_count(const Node& node, std::size_t already, Reading& reading)
{
    std::array<std::uint32_t, 3> count{1, 1, 1};
    const auto refuse = [&](std::string_view what) {
        reading.complain(node.place, what);
        return std::array<std::uint32_t, 3>{1, 1, 1};
    };
    const auto* list = std::get_if<Node::List>(&node.value);
    constexpr std::string_view expected = "count is a list of three, such as [10, 1, 10]: how many "
                                          "bodies along x, y and z, each 1 at least";
    if (list == nullptr || list->size() != 3) return refuse(expected);
    std::uint64_t product = 1;
    for (std::size_t axis = 0; axis < count.size(); ++axis) {
        const auto along = base::count_of((*list)[axis], std::numeric_limits<std::uint16_t>::max());
        if (!along || *along == 0) return refuse(expected);
        count[axis] = static_cast<std::uint32_t>(*along);
        product *= *along;
    }
    if (product > bodies_max - std::min<std::size_t>(already, bodies_max)) {
        return refuse(fmt::format("a scene has at most {} bodies", bodies_max));
    }
    return count;
}

void read_array(TableReader& table, Growing& growing)
{
    Reading& reading = table.reading();
    auto& bodies = growing.scene.bodies;
    const BodyDescription first = read_body_keys(table);
    std::array<std::uint32_t, 3> count{1, 1, 1};
    with(table, "count",
         [&](const Node& node) { count = read_count(node, bodies.size(), reading); });
    glm::dvec3 spacing{0.0};
    with(table, "spacing", [&](const Node& node) { read(node, spacing, place_span, reading); });
    const auto [nx, ny, nz] = count;
    std::size_t number = 0;
    for (std::uint32_t y = 0; y < ny; ++y) {
        for (std::uint32_t z = 0; z < nz; ++z) {
            for (std::uint32_t x = 0; x < nx; ++x) {
                BodyDescription body = first;
                body.position.value += glm::dvec3{x, y, z} * spacing;
                if (!body.name.empty()) body.name += fmt::format(" {}", ++number);
                bodies.push_back(std::move(body));
            }
        }
    }
}

/// Calls `use` with the tables of a list of them: [[body]], [[plane]].
template <typename Use>
void with_each(const Node* node, std::string_view key, Reading& reading, Use use)
{
    if (node == nullptr) return;
    const auto* list = std::get_if<Node::List>(&node->value);
    if (list == nullptr) {
        return reading.complain(node->place, fmt::format("write it as [[{}]]", key));
    }
    for (const Node& element : *list) {
        if (std::holds_alternative<Node::Table>(element.value)) {
            use(element);
        } else {
            base::complain_of(element, fmt::format("a table [[{}]]", key), reading);
        }
    }
}

void read_planes(TableReader& table, Growing& growing)
{
    Reading& reading = table.reading();
    with_each(table.find("plane"), "plane", reading, [&](const Node& node) {
        TableReader keys{std::get<Node::Table>(node.value), node.place, reading};
        PlaneDescription plane;
        with(keys, "name", [&](const Node& name) { base::read_value(name, plane.name, reading); });
        with(keys, "normal",
             [&](const Node& normal) { text::read_direction(normal, plane.normal, reading); });
        with(keys, "offset",
             [&](const Node& offset) { read(offset, plane.offset_m, place_span, reading); });
        read_material(keys, plane.material);
        keys.finish();
        growing.scene.planes.push_back(std::move(plane));
        growing.plane_places.push_back(node.place);
    });
}

/// Bodies and arrays of bodies in the order of the text, which is that of their ids.
void read_bodies(TableReader& table, Growing& growing)
{
    Reading& reading = table.reading();
    std::vector<std::pair<const Node*, bool>> nodes;
    with_each(table.find("body"), "body", reading,
              [&](const Node& node) { nodes.emplace_back(&node, false); });
    with_each(table.find("array"), "array", reading,
              [&](const Node& node) { nodes.emplace_back(&node, true); });
    std::stable_sort(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) {
        const Place& p = a.first->place;
        const Place& q = b.first->place;
        return std::pair{p.line, p.column} < std::pair{q.line, q.column};
    });
    for (const auto& [node, is_array] : nodes) {
        TableReader keys{std::get<Node::Table>(node->value), node->place, reading};
        if (is_array) {
            read_array(keys, growing);
        } else {
            growing.scene.bodies.push_back(read_body_keys(keys));
        }
        keys.finish();
        if (is_array) {
            std::ignore = keys.require("count");
            std::ignore = keys.require("spacing");
        }
        require_body_keys(keys, growing.scene.bodies.back().movable);
        if (!reading.is_good()) return;
        growing.body_places.resize(growing.scene.bodies.size(), node->place);
    }
}

void read_hands(TableReader& table, HandDescription& hands)
{
    Reading& reading = table.reading();
    with(table, "hips", [&](const Node& node) {
        const auto* entries = std::get_if<Node::Table>(&node.value);
        if (entries == nullptr) return base::complain_of(node, "a table [hips]", reading);
        TableReader keys{*entries, node.place, reading};
        with(keys, "count", [&](const Node& count) {
            const auto value = base::count_of(count, hands_max);
            if (value) hands.count = static_cast<std::uint32_t>(*value);
            const auto expected = fmt::format("a whole number of hands from 0 to {}", hands_max);
            if (!value) base::complain_of(count, expected, reading);
        });
        const auto quantity = [&](std::string_view key, double& target, const Span& span) {
            with(keys, key, [&](const Node& value) { read(value, target, span, reading); });
        };
        quantity("radius", hands.radius_m, radius_span);
        quantity("stiffness", hands.stiffness_n_per_m, stiffness_span);
        quantity("damping", hands.damping_ns_per_m, drag_span);
        quantity("grip_reach", hands.grip_reach_m, reach_span);
        with(keys, "friction", [&](const Node& friction) {
            text::read_share(friction, hands.friction, friction_max, reading);
        });
        with(keys, "force_max", [&](const Node& force) {
            const auto* word = std::get_if<std::string>(&force.value);
            if (word == nullptr || *word != "none") {
                return read(force, hands.force_max_n, force_span, reading);
            }
            hands.force_max_n = std::numeric_limits<double>::infinity();
        });
        keys.finish();
    });
}

/// Where that stands which check() finds wrong, as far as one part alone is.
Place culprit(const Growing& growing, Place otherwise)
{
    Description alone;
    for (std::size_t i = 0; i < growing.scene.planes.size(); ++i) {
        alone.planes = {growing.scene.planes[i]};
        if (!check(alone)) return growing.plane_places[i];
    }
    alone.planes.clear();
    for (std::size_t i = 0; i < growing.scene.bodies.size(); ++i) {
        alone.bodies = {growing.scene.bodies[i]};
        if (!check(alone)) return growing.body_places[i];
    }
    return otherwise;
}

} // namespace

base::Result<Description> parse_scene(std::string_view text, const std::string& source)
{
    Reading reading{source};
    const auto document = base::parse_document(text, scene_bytes_max);
    if (!document) {
        reading.complain(document.error().place, document.error().message);
        return base::fail(*reading.complaint());
    }
    TableReader table{std::get<Node::Table>(document->value), document->place, reading};
    Growing growing;
    Description& scene = growing.scene;
    with(table, "name", [&](const Node& node) { base::read_value(node, scene.name, reading); });
    with(table, "gravity",
         [&](const Node& node) { read(node, scene.gravity, gravity_span, reading); });
    read_hands(table, scene.hands);
    read_planes(table, growing);
    read_bodies(table, growing);
    table.finish();
    if (reading.is_good()) {
        if (const auto fine = check(scene); !fine) {
            reading.complain(culprit(growing, document->place), fine.error().message);
        }
    }
    if (!reading.is_good()) return base::fail(*reading.complaint());
    return std::move(scene);
}

} // namespace hapnet::scene

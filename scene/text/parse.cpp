// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/text/text.hpp"

#include "proto/base/built_in.hpp"
#include "proto/base/fields.hpp"
#include "scene/text/fields.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::scene {

namespace {

using base::Node;
using base::Place;
using base::Reading;
using base::TableReader;

constexpr std::size_t scene_bytes_max = 64U << 20U; // for the most bodies, each written alone

/// Reads a density that is written instead of a mass.
void read_density(TableReader& table, BodyDescription& body)
{
    text::Density density;
    base::read_fields(table, density);
    if (!density.kg_per_m3) return;
    const Place place = table.find("density")->place;
    Reading& reading = table.reading();
    if (table.find("mass") != nullptr) {
        return reading.complain(place,
                                "mass and density exclude each other: leave out one of them");
    }
    const double kg = mass_of(body, *density.kg_per_m3);
    if (!(kg >= mass_min_kg && kg <= mass_max_kg)) {
        return reading.complain(place,
                                fmt::format("makes a mass of {:.3g} kg: {} to {} is possible", kg,
                                            base::quantity_text(mass_min_kg, base::mass_kind),
                                            base::quantity_text(mass_max_kg, base::mass_kind)));
    }
    body.mass_kg = kg;
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

/// Reads the keys that a body and an array of bodies have in common.
BodyDescription read_body_keys(TableReader& table)
{
    BodyDescription body;
    base::read_fields(table, body);
    with_each(table.find("part"), "body.part", table.reading(), [&](const Node& node) {
        base::read_table(node, body.parts.emplace_back(), table.reading());
    });
    if (body.kinematic) body.movable = false;
    read_density(table, body);
    return body;
}

/// Requires a mass. Call it after all other keys are read, since a misspelt key is the better
/// complaint.
void require_mass(TableReader& table, bool is_movable)
{
    if (!is_movable || table.find("mass") != nullptr || table.find("density") != nullptr) return;
    table.reading().complain(table.place(), "'mass' or 'density' is missing here: a body that is "
                                            "not fixed has one, such as mass = \"100g\"");
}

/// A scene that grows body by body, and the place of each body in the text.
struct Growing {
    Description scene;
    std::vector<Place> body_places;
    std::vector<Place> plane_places;
};

void read_array(TableReader& table, Growing& growing)
{
    Reading& reading = table.reading();
    auto& bodies = growing.scene.bodies;
    const BodyDescription first = read_body_keys(table);
    text::Array array;
    base::read_fields(table, array);
    const auto [nx, ny, nz] = array.count;
    const std::uint64_t product = std::uint64_t{nx} * ny * nz;
    const Node* node = table.find("count");
    if (node != nullptr &&
        product > bodies_max - std::min<std::size_t>(bodies.size(), bodies_max)) {
        return reading.complain(node->place,
                                fmt::format("a scene has at most {} bodies", bodies_max));
    }
    std::size_t number = 0;
    for (std::uint32_t y = 0; y < ny; ++y) {
        for (std::uint32_t z = 0; z < nz; ++z) {
            for (std::uint32_t x = 0; x < nx; ++x) {
                BodyDescription body = first;
                body.position.value += glm::dvec3{x, y, z} * array.spacing;
                if (!body.name.empty()) body.name += fmt::format(" {}", ++number);
                bodies.push_back(std::move(body));
            }
        }
    }
}

void read_planes(TableReader& table, Growing& growing)
{
    Reading& reading = table.reading();
    with_each(table.find("plane"), "plane", reading, [&](const Node& node) {
        TableReader keys{std::get<Node::Table>(node.value), node.place, reading};
        PlaneDescription plane;
        base::read_fields(keys, plane);
        keys.finish();
        growing.scene.planes.push_back(std::move(plane));
        growing.plane_places.push_back(node.place);
    });
}

/// Reads bodies and arrays of bodies in the order of the text, which is the order of their ids.
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
        if (reading.is_good()) require_mass(keys, growing.scene.bodies.back().movable);
        if (!reading.is_good()) return;
        growing.body_places.resize(growing.scene.bodies.size(), node->place);
    }
}

/// Refuses joints, which a scene of an earlier version may have.
void refuse_joints(TableReader& table)
{
    for (const std::string_view key : {"hinge", "slider", "ball", "spring"}) {
        const Node* const node = table.find(key);
        if (node == nullptr) continue;
        table.reading().complain(
            node->place,
            fmt::format("scenes have no joints since version 0.3: leave out [[{}]]; a body that "
                        "slides has locked axes, one that turns about an axis has 'turning', and "
                        "a [[field]] with 'stiffness' pulls bodies as a spring does",
                        key));
    }
}

/// Returns the place of the first plane or body that check() refuses even alone, or else
/// `otherwise`.
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

template <typename Keys>
bool has_key(std::string_view key)
{
    const auto& rows = base::field_table<Keys>().rows;
    return std::any_of(rows.begin(), rows.end(),
                       [key](const base::FieldRow& row) { return row.key == key; });
}

/// Returns advice on where a key belongs, or by which other key a scene states the same; "" for a
/// key of no table.
std::string advice_on_key(std::string_view key)
{
    if (key == "radius" || key == "diameter") {
        return "the size of a sphere is its diameter: write size = \"40mm\"";
    }
    if (has_key<Description>(key)) return "write it at the top, above the first [[table]]";
    if (key == "mass" || key == "density" || has_key<BodyDescription>(key))
        return "it belongs to a body: write it below its [[body]]";
    if (has_key<text::Array>(key)) return "it belongs to many bodies: write it below [[array]]";
    if (has_key<decltype(Description::hands)>(key))
        return "it belongs to the hands: write it below [hips]";
    return "";
}

} // namespace

base::Result<Description> parse_scene(std::string_view text, const std::string& source)
{
    Reading reading{source};
    reading.advise_on_keys(advice_on_key);
    const auto document = base::parse_document(text, scene_bytes_max);
    if (!document) {
        reading.complain(document.error().place, document.error().message);
        return base::fail(*reading.complaint());
    }
    TableReader table{std::get<Node::Table>(document->value), document->place, reading};
    Growing growing;
    Description& scene = growing.scene;
    base::read_fields(table, scene);
    if (const Node* hands = table.find("hips")) base::read_table(*hands, scene.hands, reading);
    with_each(table.find("hand"), "hand", reading, [&](const Node& node) {
        base::read_table(node, scene.own_hands.emplace_back(), reading);
    });
    with_each(table.find("field"), "field", reading, [&](const Node& node) {
        base::read_table(node, scene.fields.emplace_back(), reading);
    });
    read_planes(table, growing);
    read_bodies(table, growing);
    if (reading.is_good()) refuse_joints(table);
    table.finish();
    if (reading.is_good()) {
        if (const auto fine = check(scene); !fine) {
            reading.complain(culprit(growing, document->place), fine.error().message);
        }
    }
    if (!reading.is_good()) return base::fail(*reading.complaint());
    return std::move(scene);
}

namespace {

/// Returns advice on a scene that earlier versions had; "" for other names.
std::string removed_scene(std::string_view name)
{
    constexpr std::array<std::string_view, 3> with_joints{"door", "drawer", "button"};
    constexpr std::array<std::string_view, 7> of_benches{"cubes-100", "cubes-1000", "cubes-10000",
                                                         "stack-10",  "conveyor",   "soft-and-hard",
                                                         "stick-slip"};
    const auto is_one_of = [name](const auto& names) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (is_one_of(with_joints)) return "scenes have no joints";
    if (!is_one_of(of_benches)) return "";
    return fmt::format("it is the file tests/bench/scenes/{}.toml of the source code", name);
}

} // namespace

base::Result<Description> load_scene(const std::string& file_or_name, const base::OpenFile& open)
{
    const auto found = base::find_text(file_or_name, built_in_scenes(), "a scene", open);
    const std::string went = found ? "" : removed_scene(file_or_name);
    if (!went.empty())
        return base::fail(
            fmt::format("no scene is called '{}' since version 0.3: {}", file_or_name, went));
    if (!found) return tl::unexpected{found.error()};
    return parse_scene(found->text, found->source);
}

} // namespace hapnet::scene

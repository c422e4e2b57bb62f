// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/text/text.hpp"
#include "scene/text/values.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::scene {

namespace {

bool is_same(double a, double b)
{
    return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

bool is_same(const glm::dvec3& a, const glm::dvec3& b)
{
    return is_same(a.x, b.x) && is_same(a.y, b.y) && is_same(a.z, b.z);
}

bool is_same(const glm::dquat& a, const glm::dquat& b)
{
    return is_same(a.w, b.w) && is_same(a.x, b.x) && is_same(a.y, b.y) && is_same(a.z, b.z);
}

/// A number without a unit. Of a whole number TOML would forget the sign of zero.
std::string number_text(double value)
{
    return value == 0.0 && std::signbit(value) ? "-0.0" : base::value_text(value);
}

std::string with_unit(double value, const base::QuantityKind& kind)
{
    return base::quoted(base::quantity_text(value, kind));
}

std::string with_unit(const glm::dvec3& v, const base::QuantityKind& kind)
{
    return fmt::format("[{}, {}, {}]", with_unit(v.x, kind), with_unit(v.y, kind),
                       with_unit(v.z, kind));
}

std::string size_text(const glm::dvec3& half)
{
    const glm::dvec3 edges = 2.0 * half;
    const bool is_cube = is_same(edges.x, edges.y) && is_same(edges.x, edges.z);
    return is_cube ? with_unit(edges.x, base::length_kind) : with_unit(edges, base::length_kind);
}

std::string direction_text(const glm::dvec3& v)
{
    return fmt::format("[{}, {}, {}]", number_text(v.x), number_text(v.y), number_text(v.z));
}

/// Lines `key = value`.
class Lines {
public:
    void add(std::string_view key, const std::string& value)
    {
        text_ += fmt::format("{} = {}\n", key, value);
    }
    void add(std::string_view key, double value, const base::QuantityKind& kind)
    {
        add(key, with_unit(value, kind));
    }
    void add(std::string_view key, const glm::dvec3& value, const base::QuantityKind& kind)
    {
        add(key, with_unit(value, kind));
    }
    void name(const std::string& name)
    {
        if (!name.empty()) add("name", base::quoted(name));
    }
    void material(const Material& material)
    {
        constexpr Material usual;
        if (!is_same(material.friction, usual.friction)) {
            add("friction", number_text(material.friction));
        }
        if (!is_same(material.restitution, usual.restitution)) {
            add("restitution", number_text(material.restitution));
        }
    }
    void heading(std::string_view words) { text_ += fmt::format("\n{}\n", words); }
    [[nodiscard]] std::string text() && { return std::move(text_); }

private:
    std::string text_;
};

void print_hands(Lines& lines, const HandDescription& hands)
{
    lines.heading("[hips]");
    lines.add("count", base::value_text(hands.count));
    lines.add("radius", hands.radius_m, base::length_kind);
    lines.add("stiffness", hands.stiffness_n_per_m, base::stiffness_kind);
    lines.add("damping", hands.damping_ns_per_m, base::damping_kind);
    lines.add("force_max", std::isinf(hands.force_max_n)
                               ? base::quoted("none")
                               : with_unit(hands.force_max_n, base::force_kind));
    lines.add("grip_reach", hands.grip_reach_m, base::length_kind);
    constexpr HandDescription usual;
    if (!is_same(hands.friction, usual.friction))
        lines.add("friction", number_text(hands.friction));
}

void print_plane(Lines& lines, const PlaneDescription& plane)
{
    lines.heading("[[plane]]");
    lines.name(plane.name);
    lines.add("normal", direction_text(plane.normal));
    lines.add("offset", plane.offset_m, base::length_kind);
    lines.material(plane.material);
}

void print_locked(Lines& lines, const BodyDescription& body)
{
    std::vector<std::string> axes;
    if (body.locked_x) axes.push_back(base::quoted("x"));
    if (body.locked_y) axes.push_back(base::quoted("y"));
    if (body.locked_z) axes.push_back(base::quoted("z"));
    if (!axes.empty()) lines.add("locked", fmt::format("[{}]", base::list_text(axes)));
}

void print_body(Lines& lines, const BodyDescription& body)
{
    static const BodyDescription usual;
    lines.heading("[[body]]");
    lines.name(body.name);
    if (!body.movable) lines.add("fixed", "true");
    lines.add("size", size_text(body.half));
    lines.add("position", body.position.value, base::length_kind);
    if (!is_same(body.orientation, usual.orientation)) {
        const glm::dquat& q = body.orientation;
        lines.add("orientation",
                  fmt::format("{{ w = {}, x = {}, y = {}, z = {} }}", number_text(q.w),
                              number_text(q.x), number_text(q.y), number_text(q.z)));
    }
    if (!is_same(body.velocity.value, usual.velocity.value)) {
        lines.add("velocity", body.velocity.value, base::speed_kind);
    }
    if (!is_same(body.angular_velocity, usual.angular_velocity)) {
        lines.add("angular_velocity", body.angular_velocity, base::turn_kind);
    }
    if (body.movable || !is_same(body.mass_kg, usual.mass_kg)) {
        lines.add("mass", body.mass_kg, base::mass_kind);
    }
    if (body.turning != usual.turning) {
        lines.add("turning", base::quoted(text::name_of(body.turning)));
    }
    print_locked(lines, body);
    lines.material(body.material);
    if (!is_same(body.drag_ns_per_m, usual.drag_ns_per_m)) {
        lines.add("drag", body.drag_ns_per_m, base::damping_kind);
    }
}

} // namespace

std::string to_text(const Description& description)
{
    Lines lines;
    lines.name(description.name);
    lines.add("gravity", description.gravity, base::acceleration_kind);
    print_hands(lines, description.hands);
    for (const PlaneDescription& plane : description.planes) print_plane(lines, plane);
    for (const BodyDescription& body : description.bodies) print_body(lines, body);
    return std::move(lines).text();
}

} // namespace hapnet::scene

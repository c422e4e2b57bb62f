// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/text/values.hpp"

#include "proto/base/math.hpp"

#include <array>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::scene::text {

namespace {

using base::Node;
using base::Reading;

constexpr std::array<std::string_view, 5> turnings{"free", "locked", "about-x", "about-y",
                                                   "about-z"};
// The length of what rounding has been done to once; what is nearer to 1 is left as it is, so that
// what has been printed reads back as the same bits.
constexpr double rounding = 1e-14;

const Node::List* three(const Node& node, std::string_view of_what, Reading& reading)
{
    const auto* list = std::get_if<Node::List>(&node.value);
    if (list != nullptr && list->size() == 3) return list;
    if (list != nullptr) {
        reading.complain(node.place, fmt::format("a list of {} stands where one of three, x, y and "
                                                 "z, belongs",
                                                 list->size()));
    } else {
        base::complain_of(node, fmt::format("a list of three, x, y and z, each {},", of_what),
                          reading);
    }
    return nullptr;
}

/// Scaled to the length 1; false when it is too near to zero to have a direction.
template <typename T>
bool make_unit(T& value, double square)
{
    constexpr double square_min = 1e-12;
    if (square < square_min) return false;
    if (std::abs(square - 1.0) > rounding) value = value / std::sqrt(square);
    return true;
}

/// A number without a unit that is safe to square.
double plain(const Node& node, Reading& reading)
{
    constexpr double most = 1e6;
    double value = 0.0;
    base::read_value(node, value, reading);
    if (std::abs(value) <= most) return value;
    reading.complain(node.place, fmt::format("{} is out of range: -{} to {} is possible here",
                                             base::what_it_is(node), most, most));
    return 0.0;
}

glm::dquat about(const glm::dvec3& axis, double angle)
{
    const double sine = base::sin(0.5 * angle);
    return {base::cos(0.5 * angle), sine * axis.x, sine * axis.y, sine * axis.z};
}

} // namespace

void read(const Node& node, double& target, const Span& span, Reading& reading)
{
    const auto parse = [&](std::string_view text) { return base::parse_quantity(text, span.kind); };
    double value = target;
    base::read_quantity(node, value, parse, reading);
    if (!reading.is_good()) return;
    if (!(value >= span.least && value <= span.most)) {
        return reading.complain(node.place,
                                fmt::format("{} is out of range: {} from {} to {} is possible here",
                                            base::what_it_is(node), span.kind.name,
                                            base::quantity_text(span.least, span.kind),
                                            base::quantity_text(span.most, span.kind)));
    }
    target = value;
}

void read(const Node& node, glm::dvec3& target, const Span& span, Reading& reading)
{
    const auto* list = three(node, span.kind.name, reading);
    if (list == nullptr) return;
    for (const int axis : {0, 1, 2}) {
        read((*list)[static_cast<std::size_t>(axis)], target[axis], span, reading);
    }
}

void read_size(const Node& node, glm::dvec3& target, const Span& span, Reading& reading)
{
    if (std::holds_alternative<Node::List>(node.value)) return read(node, target, span, reading);
    double edge = target.x;
    read(node, edge, span, reading);
    target = glm::dvec3{edge};
}

void read_share(const Node& node, double& target, double most, Reading& reading)
{
    double value = target;
    base::read_value(node, value, reading);
    if (!(value >= 0.0 && value <= most)) {
        return reading.complain(node.place,
                                fmt::format("{} is out of range: 0 to {} is possible here",
                                            base::what_it_is(node), most));
    }
    target = value;
}

void read_direction(const Node& node, glm::dvec3& target, Reading& reading)
{
    const auto* list = three(node, "a number", reading);
    if (list == nullptr) return;
    glm::dvec3 value{plain((*list)[0], reading), plain((*list)[1], reading),
                     plain((*list)[2], reading)};
    if (!make_unit(value, value.x * value.x + value.y * value.y + value.z * value.z)) {
        return reading.complain(node.place, "a direction is not zero: write one such as [0, 1, 0]");
    }
    target = value;
}

void read_orientation(const Node& node, glm::dquat& target, Reading& reading)
{
    constexpr double turn = 360.0 * base::radians_per_degree;
    const auto* entries = std::get_if<Node::Table>(&node.value);
    if (entries == nullptr) {
        return base::complain_of(
            node, "an axis and an angle, { axis = [0, 1, 0], angle = \"30deg\" },", reading);
    }
    base::TableReader table{*entries, node.place, reading};
    glm::dquat value = target;
    if (const Node* w = table.find("w")) {
        const auto part = [&](std::string_view key) {
            const Node* found = table.require(key);
            return found == nullptr ? 0.0 : plain(*found, reading);
        };
        value.w = plain(*w, reading);
        value.x = part("x");
        value.y = part("y");
        value.z = part("z");
        const auto& q = value;
        if (!make_unit(value, q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z)) {
            reading.complain(node.place, "a quaternion of length 0 is no orientation");
        }
    } else {
        glm::dvec3 axis{0.0, 1.0, 0.0};
        double angle = 0.0;
        const Node* axis_node = table.require("axis");
        const Node* angle_node = table.require("angle");
        if (axis_node != nullptr) read_direction(*axis_node, axis, reading);
        if (angle_node != nullptr)
            read(*angle_node, angle, {base::angle_kind, -turn, turn}, reading);
        value = about(axis, angle);
    }
    table.finish();
    if (reading.is_good()) target = value;
}

void read(const Node& node, bool& target, Reading& reading)
{
    const auto* value = std::get_if<bool>(&node.value);
    if (value == nullptr) return base::complain_of(node, "true or false", reading);
    target = *value;
}

std::string_view name_of(Turning turning) { return turnings.at(static_cast<std::size_t>(turning)); }

void read(const Node& node, Turning& target, Reading& reading)
{
    std::string name;
    base::read_value(node, name, reading);
    for (std::size_t i = 0; i < turnings.size(); ++i) {
        if (name == turnings[i]) {
            target = static_cast<Turning>(i);
            return;
        }
    }
    reading.complain(node.place, fmt::format("{} is not a way of turning: {}", base::quoted(name),
                                             base::suggestion(name, turnings)));
}

void read_locked(const Node& node, BodyDescription& target, Reading& reading)
{
    constexpr std::string_view expected = "a list of axes, such as [\"x\", \"y\"],";
    const auto* list = std::get_if<Node::List>(&node.value);
    if (list == nullptr) return base::complain_of(node, expected, reading);
    for (const Node& element : *list) {
        const auto* axis = std::get_if<std::string>(&element.value);
        if (axis == nullptr) return base::complain_of(element, "\"x\", \"y\" or \"z\"", reading);
        if (*axis == "x") {
            target.locked_x = true;
        } else if (*axis == "y") {
            target.locked_y = true;
        } else if (*axis == "z") {
            target.locked_z = true;
        } else {
            base::complain_of(element, "\"x\", \"y\" or \"z\"", reading);
        }
    }
}

} // namespace hapnet::scene::text

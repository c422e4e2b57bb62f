// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/text/formats.hpp"

#include "proto/base/math.hpp"

#include <cmath>
#include <limits>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::scene::text {

namespace {

using base::Node;
using base::Reading;

// The error of the length of a vector that was rounded once. A length that is nearer to 1 is left
// as it is, so that printed values read back as the same bits.
constexpr double rounding = 1e-14;

/// Reads a list of three. Returns nullptr after a complaint.
const Node::List* three(const Node& node, std::string_view of_what, Reading& reading)
{
    const auto* list = std::get_if<Node::List>(&node.value);
    if (list != nullptr && list->size() == 3) return list;
    if (list != nullptr) {
        reading.complain(node.place,
                         fmt::format("expected three values, x, y and z, not {}", list->size()));
    } else {
        base::complain_of(node, fmt::format("a list of three, x, y and z, each {}", of_what),
                          reading);
    }
    return nullptr;
}

/// Scales a value to the length 1. Returns false when it is too near to zero to have a direction.
template <typename T>
bool make_unit(T& value, double square)
{
    constexpr double square_min = 1e-12;
    if (square < square_min) return false;
    if (std::abs(square - 1.0) > rounding) value = value / std::sqrt(square);
    return true;
}

/// Reads a number without a unit that is safe to square.
double plain(const Node& node, Reading& reading)
{
    constexpr base::Number safe{-1e6, 1e6};
    double value = 0.0;
    safe.read(node, value, reading);
    return value;
}

glm::dquat about(const glm::dvec3& axis, double angle)
{
    const double sine = base::sin(0.5 * angle);
    return {base::cos(0.5 * angle), sine * axis.x, sine * axis.y, sine * axis.z};
}

constexpr base::Quantity edge{base::length_kind, 2.0 * size_min_m, 2.0 * size_max_m};
constexpr base::Quantity force{base::force_kind, 0.0, force_max_n};

} // namespace

void PerAxis::read(const Node& node, glm::dvec3& target, Reading& reading) const
{
    const auto* list = three(node, each.kind.name, reading);
    if (list == nullptr) return;
    for (const int axis : {0, 1, 2}) {
        each.read((*list)[static_cast<std::size_t>(axis)], target[axis], reading);
    }
}

std::string PerAxis::print(const glm::dvec3& value) const
{
    return fmt::format("[{}, {}, {}]", each.print(value.x), each.print(value.y),
                       each.print(value.z));
}

std::string PerAxis::describe() const { return "x, y and z, each " + each.describe(); }

void Edges::read(const Node& node, glm::dvec3& half, Reading& reading) const
{
    glm::dvec3 edges = 2.0 * half;
    if (std::holds_alternative<Node::List>(node.value)) {
        PerAxis{edge}.read(node, edges, reading);
    } else {
        edge.read(node, edges.x, reading);
        edges = glm::dvec3{edges.x};
    }
    half = 0.5 * edges;
}

std::string Edges::print(const glm::dvec3& half) const
{
    const glm::dvec3 edges = 2.0 * half;
    const bool is_cube = edges.x == edges.y && edges.x == edges.z;
    return is_cube ? edge.print(edges.x) : PerAxis{edge}.print(edges);
}

std::string Edges::describe() const { return edge.describe() + ", or one for each axis"; }

void Counts::read(const Node& node, Value& target, Reading& reading) const
{
    const auto* list = std::get_if<Node::List>(&node.value);
    const auto refuse = [&] {
        reading.complain(node.place, "count is a list of three, such as [10, 1, 10]: how many "
                                     "bodies along x, y and z, each 1 at least");
    };
    if (list == nullptr || list->size() != target.size()) return refuse();
    Value value{};
    for (std::size_t axis = 0; axis < value.size(); ++axis) {
        const auto along = base::count_of((*list)[axis], std::numeric_limits<std::uint16_t>::max());
        if (!along || *along == 0) return refuse();
        value[axis] = static_cast<std::uint32_t>(*along);
    }
    target = value;
}

std::string Counts::print(const Value& value) const
{
    return fmt::format("[{}]", fmt::join(value, ", "));
}

std::string Counts::describe() const
{
    return fmt::format("three whole numbers from 1 to {}",
                       std::numeric_limits<std::uint16_t>::max());
}

void Direction::read(const Node& node, glm::dvec3& target, Reading& reading) const
{
    const auto* list = three(node, "a number", reading);
    if (list == nullptr) return;
    glm::dvec3 value{plain((*list)[0], reading), plain((*list)[1], reading),
                     plain((*list)[2], reading)};
    if (!make_unit(value, value.x * value.x + value.y * value.y + value.z * value.z)) {
        return reading.complain(node.place,
                                "a direction cannot be zero: write one such as [0, 1, 0]");
    }
    target = value;
}

std::string Direction::print(const glm::dvec3& value) const
{
    return fmt::format("[{}, {}, {}]", base::value_text(value.x), base::value_text(value.y),
                       base::value_text(value.z));
}

void Orientation::read(const Node& node, glm::dquat& target, Reading& reading) const
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
            reading.complain(node.place, "a quaternion of length 0 has no orientation: write one "
                                         "such as { w = 1, x = 0, y = 0, z = 0 }");
        }
    } else {
        glm::dvec3 axis{0.0, 1.0, 0.0};
        double angle = 0.0;
        const Node* axis_node = table.require("axis");
        const Node* angle_node = table.require("angle");
        if (axis_node != nullptr) Direction{}.read(*axis_node, axis, reading);
        if (angle_node != nullptr) {
            base::Quantity{base::angle_kind, -turn, turn}.read(*angle_node, angle, reading);
        }
        value = about(axis, angle);
    }
    table.finish();
    if (reading.is_good()) target = value;
}

std::string Orientation::print(const glm::dquat& value) const
{
    return fmt::format("{{ w = {}, x = {}, y = {}, z = {} }}", base::value_text(value.w),
                       base::value_text(value.x), base::value_text(value.y),
                       base::value_text(value.z));
}

void Axes::read(const Node& node, LockedAxes& target, Reading& reading) const
{
    const auto* list = std::get_if<Node::List>(&node.value);
    if (list == nullptr) {
        return base::complain_of(node, "a list of axes such as [\"x\", \"y\"]", reading);
    }
    for (const Node& element : *list) {
        const auto* axis = std::get_if<std::string>(&element.value);
        if (axis == nullptr || (*axis != "x" && *axis != "y" && *axis != "z")) {
            return base::complain_of(element, "\"x\", \"y\" or \"z\"", reading);
        }
        bool& is_locked = *axis == "x" ? target.x : *axis == "y" ? target.y : target.z;
        is_locked = true;
    }
}

std::string Axes::print(const LockedAxes& value) const
{
    std::vector<std::string> axes;
    if (value.x) axes.push_back(base::quoted("x"));
    if (value.y) axes.push_back(base::quoted("y"));
    if (value.z) axes.push_back(base::quoted("z"));
    return fmt::format("[{}]", base::list_text(axes));
}

void Fixed::read(const Node& node, bool& movable, Reading& reading) const
{
    bool is_fixed = !movable;
    base::Flag{}.read(node, is_fixed, reading);
    movable = !is_fixed;
}

void ForceLimit::read(const Node& node, double& target, Reading& reading) const
{
    const auto* word = std::get_if<std::string>(&node.value);
    if (word == nullptr || *word != "none") return force.read(node, target, reading);
    target = std::numeric_limits<double>::infinity();
}

std::string ForceLimit::print(double value) const
{
    return std::isinf(value) ? base::quoted("none") : force.print(value);
}

std::string ForceLimit::describe() const { return force.describe() + R"(, or `"none"`)"; }

} // namespace hapnet::scene::text

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/formats.hpp"
#include "scene/description.hpp"

#include <array>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <string>

namespace hapnet::scene::text {

// Formats of a scene's values that have a notation of their own (proto/base/formats.hpp).

/// Three values of one quantity: ["0m", "22.5mm", "0m"].
struct PerAxis {
    base::Quantity each;

    void read(const base::Node& node, glm::dvec3& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const glm::dvec3& value) const;
    [[nodiscard]] std::string describe() const;

    /// Reads a place or a velocity, which store their numbers in `value`.
    template <typename V>
    requires requires(V v) { v.value; }
    void read(const base::Node& node, V& target, base::Reading& reading) const
    {
        read(node, target.value, reading);
    }
    template <typename V>
    requires requires(V v) { v.value; }
    [[nodiscard]] std::string print(const V& value) const { return print(value.value); }
};

/// The edges of a box, given as one length for a cube or one for each axis. Half of each edge is
/// stored.
struct Edges {
    void read(const base::Node& node, glm::dvec3& half, base::Reading& reading) const;
    [[nodiscard]] std::string print(const glm::dvec3& half) const;
    [[nodiscard]] std::string describe() const;
};

/// Three whole numbers of at least 1: [10, 1, 10].
struct Counts {
    using Value = std::array<std::uint32_t, 3>;

    void read(const base::Node& node, Value& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const Value& value) const;
    [[nodiscard]] std::string describe() const;
};

/// A direction: three numbers, not all of them 0. It is stored with length 1.
struct Direction {
    void read(const base::Node& node, glm::dvec3& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const glm::dvec3& value) const;
    [[nodiscard]] std::string describe() const
    {
        return "three numbers such as `[0, 1, 0]`, not all 0";
    }
};

/// An orientation: { axis = [0, 1, 0], angle = "30deg" }, or the parts of a quaternion { w = 1, x =
/// 0, y = 0, z = 0 }. It is stored with length 1 and printed as a quaternion.
struct Orientation {
    void read(const base::Node& node, glm::dquat& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const glm::dquat& value) const;
    [[nodiscard]] std::string describe() const
    {
        return R"(`{ axis = [0, 1, 0], angle = "30deg" }` or a quaternion)";
    }
};

/// A list of axes: ["x", "y"].
struct Axes {
    void read(const base::Node& node, LockedAxes& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const LockedAxes& value) const;
    [[nodiscard]] std::string describe() const { return R"(a list of axes such as `["x"]`)"; }
};

/// The key `fixed`. Its opposite, `movable`, is stored.
struct Fixed {
    void read(const base::Node& node, bool& movable, base::Reading& reading) const;
    [[nodiscard]] std::string print(bool movable) const { return movable ? "false" : "true"; }
    [[nodiscard]] std::string describe() const { return "true or false"; }
};

/// A force, or "none" for an infinite one.
struct ForceLimit {
    void read(const base::Node& node, double& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(double value) const;
    [[nodiscard]] std::string describe() const;
};

} // namespace hapnet::scene::text

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/quantity.hpp"
#include "proto/base/reading.hpp"
#include "scene/description.hpp"

namespace hapnet::scene::text {

// The values of a scene's keys. What is wrong is complained of, and leaves the target as it was.

/// What a quantity with a unit may be, both ends included.
struct Span {
    const base::QuantityKind& kind;
    double least;
    double most;
};

void read(const base::Node& node, double& target, const Span& span, base::Reading& reading);

/// Three of them: x, y, z.
void read(const base::Node& node, glm::dvec3& target, const Span& span, base::Reading& reading);

/// One quantity for all three, or a list of three.
void read_size(const base::Node& node, glm::dvec3& target, const Span& span,
               base::Reading& reading);

/// A number without a unit from 0 to `most`.
void read_share(const base::Node& node, double& target, double most, base::Reading& reading);

/// Three numbers, not all of them 0; what is kept has the length 1.
void read_direction(const base::Node& node, glm::dvec3& target, base::Reading& reading);

/// { axis = [0, 1, 0], angle = "30deg" }, or the parts of a quaternion { w = 1, x = 0, y = 0, z = 0
/// }; what is kept has the length 1.
void read_orientation(const base::Node& node, glm::dquat& target, base::Reading& reading);

void read(const base::Node& node, bool& target, base::Reading& reading);

/// The name of one of the ways of turning.
void read(const base::Node& node, Turning& target, base::Reading& reading);
[[nodiscard]] std::string_view name_of(Turning turning);

/// A list of axes: ["x", "y"].
void read_locked(const base::Node& node, BodyDescription& target, base::Reading& reading);

} // namespace hapnet::scene::text

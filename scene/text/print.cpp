// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/fields.hpp"
#include "scene/text/fields.hpp"
#include "scene/text/text.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::scene {

namespace {

template <base::Described T>
std::string lines(const T& value)
{
    std::string text;
    for (const std::string& line : base::field_texts(value, base::Print::needed)) {
        text += line + '\n';
    }
    return text;
}

/// A body by its name, or by its number where others are called so, too.
std::string name_of_body(const Description& scene, std::uint32_t body)
{
    const std::string& name = scene.bodies[body].name;
    const auto count =
        std::count_if(scene.bodies.begin(), scene.bodies.end(),
                      [&](const BodyDescription& other) { return other.name == name; });
    if (name.empty() || name.starts_with('#') || count > 1) return fmt::format("#{}", body);
    return name;
}

template <typename Keys>
std::string joint_lines(const Description& scene, const JointDescription& joint)
{
    Keys keys;
    static_cast<JointDescription&>(keys) = joint;
    keys.of = name_of_body(scene, joint.body);
    if (joint.to) keys.with = name_of_body(scene, *joint.to);
    return lines(keys);
}

std::string joint_text(const Description& scene, const JointDescription& joint)
{
    std::string text = fmt::format("\n[[{}]]\n", base::name_of(joint.kind));
    switch (joint.kind) {
    case JointKind::hinge: return text + joint_lines<text::Hinge>(scene, joint);
    case JointKind::slider: return text + joint_lines<text::Slider>(scene, joint);
    case JointKind::ball: return text + joint_lines<text::Ball>(scene, joint);
    case JointKind::spring: break;
    }
    return text + joint_lines<text::Spring>(scene, joint);
}

} // namespace

std::string to_text(const Description& description)
{
    std::string text = lines(description) + "\n[hips]\n" + lines(description.hands);
    for (const Feel& hand : description.own_hands) text += "\n[[hand]]\n" + lines(hand);
    for (const FieldDescription& field : description.fields) {
        text += "\n[[field]]\n" + lines(field);
    }
    for (const PlaneDescription& plane : description.planes) {
        text += "\n[[plane]]\n" + lines(plane);
    }
    for (const BodyDescription& body : description.bodies) {
        text += "\n[[body]]\n" + lines(body);
        for (const PartDescription& part : body.parts) text += "\n[[body.part]]\n" + lines(part);
    }
    for (const JointDescription& joint : description.joints) text += joint_text(description, joint);
    return text;
}

} // namespace hapnet::scene

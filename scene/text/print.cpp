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
    return text;
}

} // namespace hapnet::scene

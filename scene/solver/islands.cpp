// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/islands.hpp"

#include <algorithm>

namespace hapnet::scene {

void Islands::join(BodyId a, BodyId b)
{
    const BodyId one = root_of(a);
    const BodyId other = root_of(b);
    parents_[std::max(one, other)] = std::min(one, other);
}

BodyId Islands::root_of(BodyId body)
{
    while (parents_[body] != body) {
        parents_[body] = parents_[parents_[body]];
        body = parents_[body];
    }
    return body;
}

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/input.hpp"

#include <vector>

namespace hapnet::scene {

/// Which bodies belong together: a union-find. An island is known by the lowest of its ids,
/// whatever the order in which its bodies were joined.
class Islands {
public:
    explicit Islands(BodyId bodies) : parents_(bodies) {}

    /// The body is an island of its own. To be said of every body before it is joined.
    void reset(BodyId body) { parents_[body] = body; }
    void join(BodyId a, BodyId b);
    /// The lowest id of its island.
    [[nodiscard]] BodyId root_of(BodyId body);

private:
    std::vector<BodyId> parents_;
};

} // namespace hapnet::scene

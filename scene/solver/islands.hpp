// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hapnet::scene {

/// Groups bodies that belong together, by a union-find. An island is identified by the lowest
/// number of its bodies, in whatever order they were joined.
class Islands {
public:
    using Body = std::uint32_t;

    explicit Islands(std::size_t bodies) : parents_(bodies) {}

    /// Makes the body an island of its own. Call it for every body before it is joined.
    void reset(Body body) { parents_[body] = body; }
    void join(Body a, Body b)
    {
        const Body one = root_of(a);
        const Body other = root_of(b);
        parents_[std::max(one, other)] = std::min(one, other);
    }
    /// Returns the lowest number of the body's island.
    [[nodiscard]] Body root_of(Body body)
    {
        while (parents_[body] != body) {
            parents_[body] = parents_[parents_[body]];
            body = parents_[body];
        }
        return body;
    }

private:
    std::vector<Body> parents_;
};

} // namespace hapnet::scene

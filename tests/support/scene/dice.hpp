// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/math.hpp"
#include "proto/base/random.hpp"

#include <glm/vec3.hpp>

namespace hapnet::test {

/// Draws one number after the other from a stream. Each draw is a statement of its own where
/// several make a value: compilers differ in the order in which they evaluate arguments and
/// operands.
class Dice {
public:
    explicit Dice(base::RandomStream stream) : stream_{stream} {}

    std::uint64_t below(std::uint64_t most)
    {
        return stream_.below(static_cast<std::uint32_t>(most), index_++);
    }
    bool one_in(std::uint64_t most) { return below(most) == 0; }
    double share() { return stream_.uniform(index_++); } // [0, 1)
    double sign() { return 2.0 * share() - 1.0; }        // [-1, 1)
    double between(double least, double most) { return least + (most - least) * share(); }
    /// Every power of ten between the two is as likely as any other.
    double power(double least, double most)
    {
        const double low = base::log(least);
        return base::exp(low + (base::log(most) - low) * share());
    }
    /// A vector in a random direction, with a length as of power().
    glm::dvec3 vector_of_power(double least, double most)
    {
        const glm::dvec3 direction = vector();
        return power(least, most) * direction;
    }
    /// A vector in the cube [-1, 1)^3.
    glm::dvec3 vector()
    {
        const double x = sign();
        const double y = sign();
        return {x, y, sign()};
    }

private:
    base::RandomStream stream_;
    std::uint64_t index_ = 0;
};

} // namespace hapnet::test

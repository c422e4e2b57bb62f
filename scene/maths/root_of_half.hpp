// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace hapnet::scene {

/// A lower triangular G with G G^T = m / 2 for an inverse inertia m. of(v) returns G^T v. Rows of
/// axes about which the body does not turn are zero.
class RootOfHalf {
public:
    explicit RootOfHalf(const glm::dmat3& m)
    {
        for (int j = 0; j < 3; ++j) {
            double square = 0.5 * m[j][j];
            for (int k = 0; k < j; ++k) square -= lower_[k][j] * lower_[k][j];
            if (!(square > 0.0)) continue;
            lower_[j][j] = std::sqrt(square);
            for (int i = j + 1; i < 3; ++i) {
                double sum = 0.5 * m[j][i];
                for (int k = 0; k < j; ++k) sum -= lower_[k][i] * lower_[k][j];
                lower_[j][i] = sum / lower_[j][j];
            }
        }
    }
    [[nodiscard]] glm::dvec3 of(const glm::dvec3& v) const
    {
        return {glm::dot(lower_[0], v), glm::dot(lower_[1], v), glm::dot(lower_[2], v)};
    }

private:
    glm::dmat3 lower_{0.0}; // lower_[column][row]
};

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace hapnet::scene {

/// A 6x6 matrix: the identity plus a sum of outer products.
class Matrix6 {
public:
    using Vector = std::array<double, 6>;
    Matrix6()
    {
        for (std::size_t i = 0; i < 6; ++i) rows_[i][i] = 1.0;
    }
    void add(const Vector& to, const Vector& from, double scale)
    {
        for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t j = 0; j < 6; ++j) rows_[i][j] += scale * to[i] * from[j];
        }
    }
    /// Solves the equations by Gaussian elimination. The pivot is the largest entry of a column.
    void solve(Vector& x)
    {
        for (std::size_t k = 0; k < 6; ++k) {
            std::size_t pivot = k;
            for (std::size_t i = k + 1; i < 6; ++i) {
                if (std::abs(rows_[i][k]) > std::abs(rows_[pivot][k])) pivot = i;
            }
            std::swap(rows_[k], rows_[pivot]);
            std::swap(x[k], x[pivot]);
            if (rows_[k][k] == 0.0) continue;
            for (std::size_t i = k + 1; i < 6; ++i) {
                const double share = rows_[i][k] / rows_[k][k];
                for (std::size_t j = k; j < 6; ++j) rows_[i][j] -= share * rows_[k][j];
                x[i] -= share * x[k];
            }
        }
        for (std::size_t k = 6; k-- > 0;) {
            for (std::size_t j = k + 1; j < 6; ++j) x[k] -= rows_[k][j] * x[j];
            x[k] = rows_[k][k] != 0.0 ? x[k] / rows_[k][k] : 0.0;
        }
    }

private:
    std::array<Vector, 6> rows_{};
};

} // namespace hapnet::scene

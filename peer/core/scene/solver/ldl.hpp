// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace hapnet::scene {

template <std::size_t rows>
using Square = std::array<std::array<double, rows>, rows>;

/// The factors L D L' of a symmetric matrix without negative eigenvalues. A row that depends on
/// those before it (an axis that is locked, a point too many) is left out: its unknown is zero.
template <std::size_t rows>
class Ldl {
public:
    /// Reads the lower triangle.
    explicit Ldl(const Square<rows>& matrix)
    {
        for (std::size_t i = 0; i < rows; ++i) {
            double pivot = matrix[i][i];
            for (std::size_t j = 0; j < i; ++j) {
                double sum = matrix[i][j];
                for (std::size_t k = 0; k < j; ++k) sum -= lower_[j][k] * scaled_[i][k];
                scaled_[i][j] = sum;
                lower_[i][j] = sum * inverse_[j];
                pivot -= lower_[i][j] * sum;
            }
            inverse_[i] = pivot > dependent * matrix[i][i] ? 1.0 / pivot : 0.0;
        }
    }

    [[nodiscard]] std::array<double, rows> solve(std::array<double, rows> x) const
    {
        for (std::size_t i = 1; i < rows; ++i) {
            for (std::size_t j = 0; j < i; ++j) x[i] -= lower_[i][j] * x[j];
        }
        for (std::size_t i = 0; i < rows; ++i) x[i] *= inverse_[i];
        for (std::size_t i = rows - 1; i-- > 0;) {
            for (std::size_t j = i + 1; j < rows; ++j) x[i] -= lower_[j][i] * x[j];
        }
        return x;
    }

private:
    /// A pivot this small beside its diagonal is rounding: 1e-12 is some 1e4 units in the last
    /// place.
    static constexpr double dependent = 1e-12;

    Square<rows> lower_{};
    Square<rows> scaled_{}; // L D
    std::array<double, rows> inverse_{};
};

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <limits>

namespace hapnet::scene {

template <std::size_t rows>
using Square = std::array<std::array<double, rows>, rows>;

/// Returns one over a pivot of L D L', or 0 where the row depends on earlier rows. A pivot that is
/// this small compared with its diagonal is rounding. The rounding of earlier rows is multiplied by
/// what their own pivots lost: a dependent row was found to leave 1e-11. Kept pivots have at least
/// seven digits, and their inverses are finite.
[[nodiscard]] inline double inverse_of_pivot(double pivot, double diagonal)
{
    constexpr double dependent = 1e-9;
    constexpr double least = std::numeric_limits<double>::min();
    return pivot > dependent * diagonal && pivot >= least ? 1.0 / pivot : 0.0;
}

/// The factors L D L' of a symmetric matrix without negative eigenvalues. A row that depends on
/// earlier rows (a locked axis, a redundant point) is left out: its unknown is zero.
template <std::size_t rows>
class Ldl {
public:
    Ldl() = default;
    /// Reads the lower triangle.
    explicit Ldl(const Square<rows>& matrix)
    {
        Square<rows> scaled; // L D
        for (std::size_t i = 0; i < rows; ++i) {
            double pivot = matrix[i][i];
            for (std::size_t j = 0; j < i; ++j) {
                double sum = matrix[i][j];
                for (std::size_t k = 0; k < j; ++k) sum -= lower_[at(j, k)] * scaled[i][k];
                scaled[i][j] = sum;
                lower_[at(i, j)] = sum * inverse_[j];
                pivot -= lower_[at(i, j)] * sum;
            }
            inverse_[i] = inverse_of_pivot(pivot, matrix[i][i]);
        }
    }

    /// Solves with the first rows and columns alone when `x` is shorter: their factors are the
    /// first rows of all factors.
    template <std::size_t few>
    [[nodiscard]] std::array<double, few> solve(std::array<double, few> x) const
    {
        static_assert(few <= rows);
        for (std::size_t i = 1; i < few; ++i) {
            for (std::size_t j = 0; j < i; ++j) x[i] -= lower_[at(i, j)] * x[j];
        }
        for (std::size_t i = 0; i < few; ++i) x[i] *= inverse_[i];
        for (std::size_t i = few - 1; i-- > 0;) {
            for (std::size_t j = i + 1; j < few; ++j) x[i] -= lower_[at(j, i)] * x[j];
        }
        return x;
    }

private:
    static constexpr std::size_t at(std::size_t row, std::size_t column)
    {
        return row * (row - 1) / 2 + column;
    }

    std::array<double, rows*(rows - 1) / 2> lower_{}; // row after row, without the diagonal of ones
    std::array<double, rows> inverse_{};
};

} // namespace hapnet::scene

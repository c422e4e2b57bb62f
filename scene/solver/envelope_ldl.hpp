// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/bounded.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace hapnet::scene {

/// The factors L D L' of a symmetric matrix without negative eigenvalues whose rows are zero before
/// some column. The factors stay within this envelope (George, Liu, Computer Solution of Large
/// Sparse Positive Definite Systems, 1981). A row that depends on earlier rows, as in a closed
/// loop, is left out: its unknown is zero.
class EnvelopeLdl {
public:
    EnvelopeLdl() = default;
    EnvelopeLdl(std::size_t rows_max, std::size_t entries_max)
        : first_{rows_max},
          begins_{rows_max},
          entries_{entries_max},
          inverse_{rows_max},
          scaled_{rows_max}
    {}

    void clear()
    {
        first_.clear();
        begins_.clear();
        size_ = 0;
    }
    /// Adds a row whose entries begin at the column `first`, at most its own.
    void add_row(std::uint32_t first)
    {
        const auto row = static_cast<std::uint32_t>(first_.size());
        first_.add() = first;
        begins_.add() = size_;
        size_ += row - first;
    }
    /// Begins the factorisation. Call it when all rows have been added.
    void begin()
    {
        entries_.resize(size_);
        inverse_.resize(rows());
        scaled_.resize(rows());
    }

    [[nodiscard]] std::size_t rows() const { return first_.size(); }
    [[nodiscard]] std::uint32_t first(std::size_t row) const { return first_[row]; }
    /// Returns the row from its first column to its diagonal. Set it before factor().
    [[nodiscard]] double* row(std::size_t i) { return entries_.all().data() + begins_[i]; }
    [[nodiscard]] bool is_left_out(std::size_t row) const { return inverse_[row] == 0.0; }

    /// Factors one row. Call it for the rows in their order.
    void factor(std::size_t i, double diagonal);
    void leave_out(std::size_t i)
    {
        double* const lower = row(i);
        std::fill(lower, lower + (i - first_[i]), 0.0);
        inverse_[i] = 0.0;
    }
    /// Replaces the right-hand side by the unknowns.
    void solve(std::span<double> x) const;

private:
    Scratch<std::uint32_t> first_;
    Scratch<std::uint32_t> begins_;
    Scratch<double> entries_; // entries of the matrix, then of L
    Scratch<double> inverse_; // inverse of D; 0 for a row that is left out
    Scratch<double> scaled_;  // a row of L D
    std::uint32_t size_ = 0;
};

} // namespace hapnet::scene

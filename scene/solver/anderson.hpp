// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "scene/solver/ldl.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace hapnet::scene {

/// Accelerates a slowly converging iteration x -> g(x). The next x is the mixture of the last few
/// results whose steps cancel best (D. G. Anderson, J. ACM 12, 1965). Where the iteration is
/// linear, that is GMRES (Walker, Ni, SIAM J. Numer. Anal. 49, 2011): it needs as many steps as
/// there are different modes of convergence, for example one for a heavy body on a light one.
class Anderson {
public:
    static constexpr std::size_t depth = 6;

    explicit Anderson(std::size_t size_max);
    /// Makes the same room, but copies no results.
    Anderson(const Anderson& other) : Anderson{other.size_max_} {}
    Anderson(Anderson&&) noexcept = default;
    Anderson& operator=(const Anderson& other);
    Anderson& operator=(Anderson&&) noexcept = default;
    ~Anderson() = default;

    /// Forgets all results and begins a problem of `size` unknowns.
    void begin(std::size_t size);

    /// Mixes the outputs of the iterations so far. The last one had the input `in` and the output
    /// `out`. Writes the mixture to `next`, which may be `in` or `out`. Returns false if the
    /// mixture is just `out`.
    bool mix(std::span<const double> in, std::span<const double> out, std::span<double> next);

private:
    [[nodiscard]] double* step_change(std::size_t column) { return &steps_[column * size_]; }
    [[nodiscard]] double* result_change(std::size_t column) { return &results_[column * size_]; }
    void learn(std::span<const double> in, std::span<const double> out);
    [[nodiscard]] std::array<double, depth> products_with(const double* one) const;
    [[nodiscard]] std::array<double, depth> weights();

    std::size_t size_max_;
    std::size_t size_ = 0;
    std::size_t seen_ = 0; // number of results since begin()
    std::vector<double> last_step_, last_result_;
    std::vector<double> steps_, results_; // changes from one iteration to the next, a column each
    Square<depth> products_{};            // scalar products of the columns of steps_
};

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/envelope_ldl.hpp"

#include "scene/solver/ldl.hpp"

namespace hapnet::scene {

void EnvelopeLdl::factor(std::size_t i, double diagonal)
{
    double* const lower = row(i);
    const std::uint32_t first = first_[i];
    double pivot = diagonal;
    for (std::uint32_t j = first; j < i; ++j) {
        double sum = lower[j - first];
        const double* const other = entries_.all().data() + begins_[j];
        for (std::uint32_t k = std::max(first, first_[j]); k < j; ++k)
            sum -= other[k - first_[j]] * scaled_[k];
        scaled_[j] = inverse_[j] == 0.0 ? 0.0 : sum;
        lower[j - first] = scaled_[j] * inverse_[j];
        pivot -= lower[j - first] * scaled_[j];
    }
    inverse_[i] = inverse_of_pivot(pivot, diagonal);
}

void EnvelopeLdl::solve(std::span<double> x) const
{
    const std::size_t count = rows();
    const double* const entries = entries_.all().data();
    for (std::size_t i = 0; i < count; ++i) {
        const double* const lower = entries + begins_[i];
        for (std::size_t j = first_[i]; j < i; ++j) x[i] -= lower[j - first_[i]] * x[j];
    }
    for (std::size_t i = 0; i < count; ++i) x[i] *= inverse_[i];
    for (std::size_t i = count; i-- > 0;) {
        const double* const lower = entries + begins_[i];
        for (std::size_t j = first_[i]; j < i; ++j) x[j] -= lower[j - first_[i]] * x[i];
    }
}

} // namespace hapnet::scene

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/envelope_ldl.hpp"

namespace hapnet::scene {

void EnvelopeLdl::factor(std::size_t i, double diagonal)
{
    // A pivot this small beside its diagonal is rounding: the row depends on those before it. See
    // Ldl.
    constexpr double dependent = 1e-9;
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
    inverse_[i] = pivot > dependent * diagonal ? 1.0 / pivot : 0.0;
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

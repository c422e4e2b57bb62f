// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/solver/anderson.hpp"

#include <algorithm>

namespace hapnet::scene {

Anderson::Anderson(std::size_t size_max) : size_max_{size_max}
{
    last_step_.reserve(size_max);
    last_result_.reserve(size_max);
    steps_.reserve(depth * size_max);
    results_.reserve(depth * size_max);
}

Anderson& Anderson::operator=(const Anderson& other)
{
    if (this != &other && size_max_ != other.size_max_) *this = Anderson{other.size_max_};
    return *this;
}

void Anderson::begin(std::size_t size)
{
    size_ = size;
    seen_ = 0;
    last_step_.resize(size);
    last_result_.resize(size);
    steps_.resize(depth * size);
    results_.resize(depth * size);
}

bool Anderson::mix(std::span<const double> in, std::span<const double> out, std::span<double> next)
{
    learn(in, out);
    std::copy(out.begin(), out.end(), next.begin());
    if (seen_ < 2) return false;
    const std::array<double, depth> weight = weights();
    const std::size_t columns = std::min(seen_ - 1, depth);
    for (std::size_t column = 0; column < columns; ++column) {
        if (weight[column] == 0.0) continue;
        const double* const change = result_change(column);
        for (std::size_t i = 0; i < size_; ++i) next[i] -= weight[column] * change[i];
    }
    return true;
}

void Anderson::learn(std::span<const double> in, std::span<const double> out)
{
    if (seen_ > 0) {
        const std::size_t column = (seen_ - 1) % depth;
        double* const step = step_change(column);
        double* const result = result_change(column);
        for (std::size_t i = 0; i < size_; ++i) {
            step[i] = (out[i] - in[i]) - last_step_[i];
            result[i] = out[i] - last_result_[i];
        }
        const std::size_t columns = std::min(seen_, depth);
        const std::array<double, depth> its = products_with(step);
        for (std::size_t other = 0; other < columns; ++other)
            products_[column][other] = products_[other][column] = its[other];
    }
    for (std::size_t i = 0; i < size_; ++i) last_step_[i] = out[i] - in[i];
    std::copy(out.begin(), out.end(), last_result_.begin());
    ++seen_;
}

/// Returns the products with each column of steps_. A single sum would wait for itself at every
/// step, so the sums are computed in parallel, also those of columns that are not filled yet.
std::array<double, Anderson::depth> Anderson::products_with(const double* one) const
{
    std::array<double, depth> sums{};
    const double* const steps = steps_.data();
    for (std::size_t i = 0; i < size_; ++i) {
        for (std::size_t column = 0; column < depth; ++column)
            sums[column] += one[i] * steps[column * size_ + i];
    }
    return sums;
}

/// Returns the weights with which the columns, subtracted from the last step, leave the shortest
/// step.
std::array<double, Anderson::depth> Anderson::weights()
{
    const std::size_t columns = std::min(seen_ - 1, depth);
    Square<depth> matrix{};
    std::array<double, depth> wanted{};
    const std::array<double, depth> missed = products_with(last_step_.data());
    // The newest column comes first: of columns that depend on each other it is the one that
    // counts.
    const auto column_of = [&](std::size_t age) { return (seen_ - 2 - age) % depth; };
    for (std::size_t i = 0; i < columns; ++i) {
        for (std::size_t j = 0; j <= i; ++j) matrix[i][j] = products_[column_of(i)][column_of(j)];
        wanted[i] = missed[column_of(i)];
    }
    const std::array<double, depth> by_age = Ldl<depth>{matrix}.solve(wanted);
    std::array<double, depth> weight{};
    for (std::size_t i = 0; i < columns; ++i) weight[column_of(i)] = by_age[i];
    return weight;
}

} // namespace hapnet::scene

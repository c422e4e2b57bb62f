// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/bounds.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <cstddef>
#include <string_view>

namespace hapnet::emulator {

/// Quantiles of the gamma distribution of mean 1. From shape 1000 on it uses the Cornish-Fisher
/// expansion, and below it interpolates between exact values. Each exact value is computed when a
/// draw first comes near it, so that a new shape costs nothing until it is used. Nothing is
/// allocated. The result is within 2e-8 of the true value (relative, or of the mean where that is
/// larger).
class GammaQuantile {
public:
    static constexpr double shape_min = 0.01;
    static constexpr double z_max = 8.5; // no draw lies beyond: uniform numbers have 53 bits

    /// shape = (mean / sd)^2, at least shape_min.
    explicit GammaQuantile(double shape);

    /// Returns the quantile of probability normal_cdf(z), |z| <= z_max.
    [[nodiscard]] double at(double z);

private:
    /// The logarithm of the quantile, and its derivative by z.
    struct Node {
        double value;
        double slope;
    };
    static constexpr int nodes_per_unit = 16;
    static constexpr std::size_t nodes = 17 * nodes_per_unit + 1; // from -z_max to z_max

    [[nodiscard]] const Node& node(std::size_t index);
    [[nodiscard]] Node solve(double z) const;
    [[nodiscard]] double expansion(double z) const;

    double shape_;
    double log_shape_ = 0.0;
    double log_gamma_ = 0.0;          // log gamma(shape)
    std::array<Node, nodes> nodes_{}; // NaN: not computed yet
};

/// Gamma on [0, infinity); mean > 0, 0 < sd <= 10 mean.
struct GammaLaw {
    base::Duration mean{};
    base::Duration sd{};

    class Sampler;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LawMoments moments() const;

    friend bool operator==(const GammaLaw&, const GammaLaw&) = default;
};

constexpr auto fields_of(base::Tag<GammaLaw>)
{
    return base::fields(
        "gamma", base::field("mean", &GammaLaw::mean, any_delay, "mean").required(),
        base::field("sd", &GammaLaw::sd, delay_width, "standard deviation").required());
}

class GammaLaw::Sampler {
public:
    explicit Sampler(const GammaLaw& law);

    [[nodiscard]] base::Duration quantile(double u);

    /// Changes the law. While the shape stays equal, the computed quantiles are kept.
    void change(const GammaLaw& law);

private:
    double mean_;
    double shape_;
    GammaQuantile quantiles_;
};

} // namespace hapnet::emulator

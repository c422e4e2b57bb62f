// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/gamma.hpp"
#include "emulator/core/delay/law.hpp"
#include "emulator/core/delay/table.hpp"
#include "proto/base/time.hpp"

#include <memory>
#include <variant>

namespace hapnet::emulator {

// A law made ready for drawing: what does not change from one draw to the next is worked out.
// quantile(u) is the delay that a share u of all delays stays below, 0 < u < 1, rounded to
// nanoseconds and cut at +-longest_delay. Quantities are in nanoseconds.

struct ConstantSampler {
    base::Duration value;
    [[nodiscard]] base::Duration quantile(double u) const;
};

struct UniformSampler {
    base::Duration mean;
    double half_width;
    [[nodiscard]] base::Duration quantile(double u) const;
};

struct NormalSampler {
    double mean;
    double sd;
    [[nodiscard]] base::Duration quantile(double u) const;
};

struct LogNormalSampler {
    double log_mean; // mean of the logarithm
    double log_sd;
    [[nodiscard]] base::Duration quantile(double u) const;
};

struct ExponentialSampler {
    double mean;
    [[nodiscard]] base::Duration quantile(double u) const;
};

struct ParetoSampler {
    double least;
    double exponent; // 1 / shape
    [[nodiscard]] base::Duration quantile(double u) const;
};

struct GammaSampler {
    double mean;
    double shape;
    GammaQuantile quantiles;
    [[nodiscard]] base::Duration quantile(double u);
};

struct TableSampler {
    double offset;
    double scale;
    std::shared_ptr<const QuantileTable> table;
    [[nodiscard]] base::Duration quantile(double u) const;
};

using Sampler = std::variant<ConstantSampler, UniformSampler, NormalSampler, LogNormalSampler,
                             ExponentialSampler, ParetoSampler, GammaSampler, TableSampler>;

/// For every law but a trace, which is not drawn from. Parameters just outside of their range, as
/// the rounding of a ramp makes them, count as the nearest that are possible.
[[nodiscard]] Sampler make_sampler(const DelayLaw& law);

/// sampler = make_sampler(law), but what still holds stays.
void adapt(Sampler& sampler, const DelayLaw& law);

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/bounds.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <string_view>

namespace hapnet::emulator {

/// Pareto (of the first kind) on [mean (shape - 1) / shape, infinity); shape > 1. Its standard
/// deviation is infinite for shape <= 2.
struct ParetoLaw {
    base::Duration mean{};
    double shape = 3.0;

    class Sampler;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LawMoments moments() const;

    friend bool operator==(const ParetoLaw&, const ParetoLaw&) = default;
};

constexpr auto fields_of(base::Tag<ParetoLaw>)
{
    return base::fields("pareto",
                        base::field("mean", &ParetoLaw::mean, delay_width, "mean").required(),
                        base::field("shape", &ParetoLaw::shape, "above 1; small is heavy-tailed"));
}

class ParetoLaw::Sampler {
public:
    explicit Sampler(const ParetoLaw& law);

    [[nodiscard]] base::Duration quantile(double u) const;

private:
    double least_;
    double exponent_; // 1 / shape
};

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/bounds.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <string_view>

namespace hapnet::emulator {

/// Exponential on [0, infinity); standard deviation = mean.
struct ExponentialLaw {
    base::Duration mean{};

    class Sampler;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LawMoments moments() const;

    friend bool operator==(const ExponentialLaw&, const ExponentialLaw&) = default;
};

constexpr auto fields_of(base::Tag<ExponentialLaw>)
{
    return base::fields("exponential", base::field("mean", &ExponentialLaw::mean, delay_width,
                                                   "mean, and standard deviation")
                                           .required());
}

class ExponentialLaw::Sampler {
public:
    explicit Sampler(const ExponentialLaw& law);

    [[nodiscard]] base::Duration quantile(double u) const;

private:
    double mean_;
};

} // namespace hapnet::emulator

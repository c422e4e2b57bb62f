// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/bounds.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <string_view>

namespace hapnet::emulator {

/// exp of a Gaussian; mean and sd are those of the delay itself, not of its logarithm. mean > 0.
struct LogNormalLaw {
    base::Duration mean{};
    base::Duration sd{};

    class Sampler;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LawMoments moments() const;

    friend bool operator==(const LogNormalLaw&, const LogNormalLaw&) = default;
};

constexpr auto fields_of(base::Tag<LogNormalLaw>)
{
    return base::fields(
        "log-normal", base::field("mean", &LogNormalLaw::mean, any_delay, "mean").required(),
        base::field("sd", &LogNormalLaw::sd, delay_width, "standard deviation").required());
}

class LogNormalLaw::Sampler {
public:
    explicit Sampler(const LogNormalLaw& law);

    [[nodiscard]] base::Duration quantile(double u) const;

private:
    double log_mean_; // mean of the logarithm
    double log_sd_;
};

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/bounds.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <string_view>

namespace hapnet::emulator {

/// Uniform on [mean - half_width, mean + half_width]; standard deviation half_width / sqrt(3).
struct UniformLaw {
    base::Duration mean{};
    base::Duration half_width{};

    class Sampler;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LawMoments moments() const;

    friend bool operator==(const UniformLaw&, const UniformLaw&) = default;
};

constexpr auto fields_of(base::Tag<UniformLaw>)
{
    return base::fields(
        "uniform", base::field("mean", &UniformLaw::mean, any_delay, "middle of the range"),
        base::field("half_width", &UniformLaw::half_width, delay_width,
                    "largest distance of a uniform draw from the mean: 5ms is -5ms to +5ms")
            .required());
}

class UniformLaw::Sampler {
public:
    explicit Sampler(const UniformLaw& law);

    [[nodiscard]] base::Duration quantile(double u) const;

private:
    base::Duration mean_;
    double half_width_;
};

} // namespace hapnet::emulator

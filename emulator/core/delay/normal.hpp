// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/bounds.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <string_view>

namespace hapnet::emulator {

/// The normal (Gaussian) law.
struct NormalLaw {
    base::Duration mean{};
    base::Duration sd{};

    class Sampler;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LawMoments moments() const;

    friend bool operator==(const NormalLaw&, const NormalLaw&) = default;
};

constexpr auto fields_of(base::Tag<NormalLaw>)
{
    return base::fields(
        "normal", base::field("mean", &NormalLaw::mean, any_delay, "mean"),
        base::field("sd", &NormalLaw::sd, delay_width, "standard deviation").required());
}

class NormalLaw::Sampler {
public:
    explicit Sampler(const NormalLaw& law);

    [[nodiscard]] base::Duration quantile(double u) const;

private:
    double mean_;
    double sd_;
};

} // namespace hapnet::emulator

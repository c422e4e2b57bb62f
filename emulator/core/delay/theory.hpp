// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/law.hpp"
#include "emulator/core/delay/sampler.hpp"
#include "proto/base/time.hpp"

#include <optional>
#include <vector>

namespace hapnet::emulator {

/// What a law promises before anything is drawn. Does not know of the order of departure, nor that
/// nothing leaves before it arrives (see clipped_share). A correlation changes none of it.
class DelayTheory {
public:
    /// There is no objection() to `law`.
    explicit DelayTheory(const DelayLaw& law);

    [[nodiscard]] base::Duration mean() const { return mean_; }

    /// nullopt: infinite, or longer than any delay.
    [[nodiscard]] std::optional<base::Duration> sd() const { return sd_; }

    /// The delay that a share q of all delays stays below, 0 < q < 1.
    [[nodiscard]] base::Duration quantile(double q);

    /// The share of delays below `limit`, within 1e-15.
    [[nodiscard]] double share_below(base::Duration limit);

    /// The delay when it is always the same.
    [[nodiscard]] std::optional<base::Duration> constant() const;

private:
    /// A value of a trace, and the share of values that are not greater.
    struct Step {
        base::Duration delay;
        double share;
    };

    base::Duration mean_{};
    std::optional<base::Duration> sd_;
    Sampler sampler_;
    std::vector<Step> steps_; // instead of the sampler, when not empty; ascending
};

/// The share of datagrams for which delay and jitter together are less than nothing, and which
/// therefore leave at once: exact when one of the two is constant, else within 1e-3.
[[nodiscard]] double clipped_share(const DelayLaw& delay, const DelayLaw& jitter);

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/delay.hpp"
#include "proto/base/time.hpp"

#include <optional>
#include <vector>

namespace hapnet::emulator {

/// Theoretical properties of a law, known before anything is drawn. They leave out the order of
/// departure, and the rule that nothing leaves before it arrives (see clipped_share). A correlation
/// does not change them.
class DelayTheory {
public:
    /// `law` is one that validate() accepts.
    explicit DelayTheory(const DelayLaw& law);

    [[nodiscard]] base::Duration mean() const { return mean_; }

    /// Returns the standard deviation; nullopt: infinite, or longer than any delay.
    [[nodiscard]] std::optional<base::Duration> sd() const { return sd_; }

    /// Returns the delay that a share q of all delays stays below, 0 < q < 1.
    [[nodiscard]] base::Duration quantile(double q);

    /// Returns the share of delays below `limit`, within 1e-15.
    [[nodiscard]] double share_below(base::Duration limit);

    /// Returns the delay if it is constant.
    [[nodiscard]] std::optional<base::Duration> constant() const;

private:
    base::Duration mean_{};
    std::optional<base::Duration> sd_;
    DelaySampler sampler_;
    std::vector<TraceLaw::Step> steps_; // values of a trace; empty for other laws
};

/// Returns the share of datagrams for which delay and jitter together are negative, so that they
/// leave at once. Exact when one of the two is constant, else within 1e-3.
[[nodiscard]] double clipped_share(const DelayLaw& delay, const DelayLaw& jitter);

} // namespace hapnet::emulator

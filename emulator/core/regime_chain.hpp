// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hapnet::emulator {

/// Returns, for each regime, the share in which it follows the one at `index`. The shares add up to
/// 1, and that of `index` itself is 0.
[[nodiscard]] std::vector<double> followers_of(std::span<const Regime> regimes, std::size_t index);

/// Returns the share of the time that each regime lasts in the long run.
[[nodiscard]] std::vector<double> shares_of(std::span<const Regime> regimes);

/// The time that one regime has lasted in all, and the number of its stays.
struct RegimeCourse {
    base::Duration time{};
    std::uint64_t stays = 0;
};

/// The regime at each time, as a Markov chain in continuous time. It depends only on the regimes
/// and on its stream; the times at which it is asked do not matter. Its first state is drawn from
/// the stationary law.
class RegimeChain {
public:
    /// `regimes` is one that validate() accepts, and not empty.
    RegimeChain(const Regimes& regimes, const base::RandomStream& stream);

    /// Returns the index of the regime at this time since the start of the run. The time must not
    /// be negative or earlier than in the last call.
    [[nodiscard]] std::size_t at(base::Duration time)
    {
        while (time >= end_) move_on();
        return now_;
    }

    /// Returns the index of the regime that at() returned last.
    [[nodiscard]] std::size_t current() const { return now_; }

    /// Returns the time when the regime of current() ends.
    [[nodiscard]] base::Duration end() const { return end_; }

    /// Returns the time and the stays of each regime until this time, or until the time of the last
    /// call of at() if that is later.
    [[nodiscard]] std::vector<RegimeCourse> course(base::Duration until) const;

private:
    void move_on();
    [[nodiscard]] base::Duration drawn_stay() const;

    struct State {
        double stay_ns = 0.0;
        std::vector<double> followers;
    };
    std::vector<State> states_;
    base::RandomStream stream_;
    std::uint64_t stays_ = 1; // number of stays that have begun
    std::size_t now_ = 0;
    base::Duration begin_{};
    base::Duration end_{};
    std::vector<RegimeCourse> past_; // without the current stay
};

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <chrono>
#include <optional>

namespace hapnet::lab::live {

/// The last part of a seek, which viewers see.
inline constexpr base::Duration shown_of_a_seek{std::chrono::milliseconds{20}};

/// The pace of virtual time against a clock. It reads no clock: callers pass the time.
class Pace {
public:
    static constexpr double factor_min = 0.1;
    static constexpr double factor_max = 100.0;

    /// `factor` is in virtual seconds per second; nullopt: as fast as possible.
    explicit Pace(std::optional<double> factor, bool plays) : factor_{factor}, plays_{plays} {}

    void play() { plays_ = true; }
    void pause() { plays_ = false; }
    void set_factor(std::optional<double> factor) { factor_ = factor; }

    [[nodiscard]] bool plays() const { return plays_; }
    [[nodiscard]] std::optional<double> factor() const { return factor_; }

    /// Returns the virtual time to play for the time that has passed on the clock. It is in whole
    /// ticks; the remainder is carried over. nullopt: play as fast as possible.
    [[nodiscard]] std::optional<base::Duration> due(base::Duration passed, base::Duration tick);

private:
    std::optional<double> factor_;
    bool plays_;
    double owed_s_ = 0.0;
};

} // namespace hapnet::lab::live

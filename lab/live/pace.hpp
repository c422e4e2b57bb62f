// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <chrono>
#include <optional>

namespace hapnet::lab::live {

/// After a seek those who watch see the last of the way there.
inline constexpr base::Duration shown_of_a_seek{std::chrono::milliseconds{20}};

/// How fast virtual time goes by against a clock. Reads none: it is told the time.
class Pace {
public:
    static constexpr double factor_min = 0.1;
    static constexpr double factor_max = 100.0;

    /// `factor` virtual seconds a second; nullopt: as fast as possible.
    explicit Pace(std::optional<double> factor, bool plays) : factor_{factor}, plays_{plays} {}

    void play() { plays_ = true; }
    void pause() { plays_ = false; }
    void set_factor(std::optional<double> factor) { factor_ = factor; }

    [[nodiscard]] bool plays() const { return plays_; }
    [[nodiscard]] std::optional<double> factor() const { return factor_; }

    /// How much virtual time to play for this much of the clock's: whole ticks, the rest is kept.
    /// nullopt: as much as is possible.
    [[nodiscard]] std::optional<base::Duration> due(base::Duration passed, base::Duration tick);

private:
    std::optional<double> factor_;
    bool plays_;
    double owed_s_ = 0.0;
};

} // namespace hapnet::lab::live

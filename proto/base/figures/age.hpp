// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/figures/moments.hpp"
#include "proto/base/time.hpp"

#include <algorithm>
#include <optional>

namespace hapnet::base {

/// The age of information (Kaul, Yates, Gruteser, "Real-time status: how often should one update?",
/// 2012): the time since the newest of the updates that have arrived was sent. nullopt: not
/// measured.
struct Age {
    std::optional<Duration> mean;      // mean over time
    std::optional<Duration> peak_mean; // mean of the values just before newer updates arrive
    std::optional<Duration> peak_max;

    friend bool operator==(const Age&, const Age&) = default;
};
constexpr auto fields_of(Tag<Age>)
{
    return fields("age", member("mean", &Age::mean), member("peak_mean", &Age::peak_mean),
                  member("peak_max", &Age::peak_max));
}

/// Measures the age of information as updates arrive.
class AgeMeter {
public:
    /// Adds an update that is newer than all before it, and that arrives `delay` after it was sent.
    /// `arrived` must not be before the arrival of the previous update.
    void add(TimePoint arrived, Duration delay)
    {
        if (newest_) {
            // Between two updates the age grows by one second per second. Its integral is a
            // trapezium.
            const Duration held = arrived - newest_->arrived;
            const Duration peak = newest_->delay + held;
            time_ += held;
            area_ns2_ += to_nanoseconds(held) * to_nanoseconds(newest_->delay + peak) / 2.0;
            peaks_.add(peak);
            peak_max_ = std::max(peak_max_, peak);
        }
        newest_ = Update{arrived, delay};
    }

    /// Excludes the time until the next update.
    void pause() { newest_.reset(); }

    /// Returns the arrival time of the newest update; nullopt at first and after a pause.
    [[nodiscard]] std::optional<TimePoint> newest_arrived() const
    {
        return newest_ ? std::optional{newest_->arrived} : std::nullopt;
    }

    [[nodiscard]] Age age() const
    {
        if (peaks_.count() == 0) return {};
        Age age{{}, peaks_.moments()->mean, peak_max_};
        if (time_ > Duration{0}) age.mean = nearest_duration(area_ns2_ / to_nanoseconds(time_));
        return age;
    }

private:
    struct Update {
        TimePoint arrived{};
        Duration delay{};
    };

    std::optional<Update> newest_;
    Duration time_{};       // time during which the age was measured
    double area_ns2_ = 0.0; // the age, integrated over that time
    RunningMoments peaks_;
    Duration peak_max_{};
};

} // namespace hapnet::base

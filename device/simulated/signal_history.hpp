// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <glm/vec3.hpp>

namespace hapnet::device {

/// The past values of a vector, for delayed perception by nerves. A value is in effect until the
/// next one. Before the first value it is zero. 1024 samples are kept, a second of ticks; for an
/// earlier time the oldest of them is returned.
class SignalHistory {
public:
    static constexpr base::Duration delay_max{std::chrono::seconds{1}};

    /// Adds a value. `now` never runs backwards.
    void put(base::TimePoint now, const glm::dvec3& value)
    {
        samples_[written_ % samples_.size()] = {now, value};
        ++written_;
    }

    /// Returns the value at `then`, which never runs backwards.
    [[nodiscard]] glm::dvec3 at(base::TimePoint then)
    {
        if (written_ - read_ > samples_.size()) read_ = written_ - samples_.size();
        while (read_ + 1 < written_ && sample(read_ + 1).time <= then) ++read_;
        const bool is_known = read_ < written_ && sample(read_).time <= then;
        return is_known ? sample(read_).value : glm::dvec3{0.0};
    }

private:
    struct Sample {
        base::TimePoint time;
        glm::dvec3 value{0.0};
    };
    [[nodiscard]] const Sample& sample(std::uint64_t number) const
    {
        return samples_[number % samples_.size()];
    }

    std::array<Sample, 1024> samples_{};
    std::uint64_t written_ = 0; // number of samples
    std::uint64_t read_ = 0;    // number of the sample returned last
};

} // namespace hapnet::device

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/self_test/step.hpp"
#include "proto/base/histogram.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <optional>

namespace hapnet::peer::self_test {

/// Reads without force. Measures how often the device has new data, and how long it is silent. The
/// verdict uses the median interval between two reports, because some devices send nothing while
/// they do not move.
class ReadStep {
public:
    ReadStep(base::Duration length, double nominal_hz) : length_{length}, nominal_hz_{nominal_hz} {}

    [[nodiscard]] StepRequest on_tick(const StepInput& input, base::TimePoint now);
    [[nodiscard]] Outcome outcome() const;

    /// The upper edges, in ms, of the histogram's bins for the interval between two reports. The
    /// last bin has no upper edge.
    static constexpr std::array edges_ms{0.5, 0.9, 1.1, 1.5, 2.0, 5.0, 20.0};

private:
    void count_gap(base::Duration gap);
    [[nodiscard]] std::string drawing() const;

    base::Duration length_;
    double nominal_hz_;
    std::optional<base::TimePoint> start_;
    std::optional<base::TimePoint> heard_;
    base::TimePoint now_;
    std::uint64_t sequence_ = 0;
    std::uint64_t reports_ = 0;
    base::DurationHistogram all_gaps_;
    std::array<std::uint64_t, edges_ms.size() + 1> gaps_{};
    device::Fault fault_ = device::Fault::none;
};

} // namespace hapnet::peer::self_test

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/self_test/step.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <optional>

namespace hapnet::peer::self_test {

/// Waits for the cable to be pulled. The step passes if the device then reports a fault.
class CableStep {
public:
    static constexpr base::Duration patience{std::chrono::seconds{30}};

    [[nodiscard]] StepRequest on_tick(const StepInput& input, base::TimePoint now);
    [[nodiscard]] Outcome outcome() const;

private:
    std::optional<base::TimePoint> start_;
    std::optional<base::TimePoint> heard_;
    std::uint64_t sequence_ = 0;
    base::Duration silent_for_{};
    bool was_well_ = false; // the device was without a fault at some time in this step
    device::Fault fault_ = device::Fault::none;
};

} // namespace hapnet::peer::self_test

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/self_test/step.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <optional>

namespace hapnet::peer::self_test {

/// Waits until the device is calibrated and held, and prompts the person for what is missing.
class CalibrateStep {
public:
    static constexpr base::Duration patience{std::chrono::seconds{60}};

    [[nodiscard]] StepRequest on_tick(const StepInput& input, base::TimePoint now);
    [[nodiscard]] Outcome outcome() const;

private:
    std::optional<base::TimePoint> start_;
    base::Duration took_{};
    Prompt prompt_ = Prompt::nothing; // last prompt; nothing: the step has passed
    bool has_failed_ = false;         // the device reports a failed calibration
};

} // namespace hapnet::peer::self_test

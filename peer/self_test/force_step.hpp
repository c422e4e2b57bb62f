// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/self_test/step.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <optional>

namespace hapnet::peer::self_test {

/// The hand that holds the dead man's button.
enum class DeadMan : std::uint8_t { person, simulated_hand };

/// Applies a force along x that rises to 0.2 N in 2 s, stays for a second, and falls again. There
/// is force only while the primary button is held; when it is held again, the ramp begins again. A
/// button that is pressed from the start may be stuck or read inverted, so that it could not be
/// released. It counts only after it was seen released.
class ForceStep {
public:
    static constexpr double peak_n = 0.2;
    static constexpr base::Duration ramp{std::chrono::seconds{2}};
    static constexpr base::Duration plateau{std::chrono::seconds{1}};
    static constexpr base::Duration patience{std::chrono::seconds{60}};
    /// The time within which a governor must have faded the force to zero.
    static constexpr base::Duration zero_after{std::chrono::milliseconds{100}};

    explicit ForceStep(DeadMan dead_man) : dead_man_{dead_man} {}

    [[nodiscard]] StepRequest on_tick(const StepInput& input, base::TimePoint now);
    [[nodiscard]] Outcome outcome() const;

private:
    void watch(const StepInput& input, bool is_held, base::TimePoint now);
    [[nodiscard]] static double wanted_n(base::Duration into);

    DeadMan dead_man_;
    bool was_up_ = false; // the button was seen released
    std::optional<base::TimePoint> start_;
    std::optional<base::TimePoint> held_since_;
    std::optional<base::TimePoint> released_at_;
    double force_most_n_ = 0.0;
    bool is_complete_ = false;
    bool was_released_ = false; // the button was released after it was held
    bool outlasted_release_ = false;
    device::Fault fault_ = device::Fault::none;
};

} // namespace hapnet::peer::self_test

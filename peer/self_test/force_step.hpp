// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/self_test/step.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <optional>

namespace hapnet::peer::self_test {

/// The hand that keeps the dead man's button down.
enum class DeadMan : std::uint8_t { person, simulated_hand };

/// A ramp to 0.2 N along x in 2 s, a second there, and down again, only while the primary button is
/// held; the ramp begins again when it is held again. A button that is down from the start on may
/// be stuck, or read the wrong way round, and could not be let go of: it counts once it was seen
/// up.
class ForceStep {
public:
    static constexpr double peak_n = 0.2;
    static constexpr base::Duration ramp{std::chrono::seconds{2}};
    static constexpr base::Duration plateau{std::chrono::seconds{1}};
    static constexpr base::Duration patience{std::chrono::seconds{60}};
    /// The time by which a governor has faded the force to zero.
    static constexpr base::Duration zero_after{std::chrono::milliseconds{100}};

    explicit ForceStep(DeadMan dead_man) : dead_man_{dead_man} {}

    [[nodiscard]] StepRequest on_tick(const StepInput& input, base::TimePoint now);
    [[nodiscard]] Outcome outcome() const;

private:
    void watch(const StepInput& input, bool is_held, base::TimePoint now);
    [[nodiscard]] static double wanted_n(base::Duration into);

    DeadMan dead_man_;
    bool was_up_ = false; // the button was seen up
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

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "peer/self_test/cable_step.hpp"
#include "peer/self_test/calibrate_step.hpp"
#include "peer/self_test/force_step.hpp"
#include "peer/self_test/read_step.hpp"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace hapnet::peer::self_test {

/// The settings of a self-test.
struct Plan {
    device::Capabilities capabilities{};
    bool is_real = true; // a person holds the device, and it has a cable
    base::Duration read_for{std::chrono::seconds{10}};
    std::vector<std::string> skip{}; // names of steps
};

/// Runs the steps one after the other. Does no I/O and reads no clock: call on_tick() once a tick.
class SelfTest {
public:
    explicit SelfTest(const Plan& plan);

    /// Returns the request for this tick. `is_done` refers to the whole test.
    [[nodiscard]] StepRequest on_tick(const StepInput& input, base::TimePoint now);

    /// Returns the outcomes of the finished and the skipped steps. After the test these are all
    /// steps.
    [[nodiscard]] const std::vector<Outcome>& outcomes() const { return outcomes_; }
    /// Stops the test: the current step and all later ones are skipped.
    void stop() { skip_rest("the test was broken off"); }
    /// True if every step was done or was skipped by choice. The test was then not stopped, and the
    /// device stayed connected.
    [[nodiscard]] bool is_finished() const { return at_ == steps_.size() && !is_cut_short_; }

private:
    using Step = std::variant<ReadStep, CalibrateStep, ForceStep, CableStep>;
    struct Planned {
        std::string_view name;
        Step step;
        std::string why_not; // why the step is skipped; "": it is done
    };

    void skip_to_next();
    void skip_rest(std::string_view why);

    std::vector<Planned> steps_;
    std::size_t at_ = 0;
    bool is_cut_short_ = false;
    std::vector<Outcome> outcomes_;
};

} // namespace hapnet::peer::self_test

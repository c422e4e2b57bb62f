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

/// What is to be tried.
struct Plan {
    device::Capabilities capabilities{};
    bool is_real = true; // a person holds it, and it has a cable
    base::Duration read_for{std::chrono::seconds{10}};
    std::vector<std::string> skip{}; // names of steps
};

/// The steps one after the other. Does no I/O and reads no clock: call on_tick() once a tick.
class SelfTest {
public:
    explicit SelfTest(const Plan& plan);

    /// What to do in this tick. `is_done` is that of the whole test.
    [[nodiscard]] Turn on_tick(const Feeling& feeling, base::TimePoint now);

    /// Of the steps that are over, or were left out; after the end of all.
    [[nodiscard]] const std::vector<Outcome>& outcomes() const { return outcomes_; }
    /// The test is broken off: what is under way and what would come is skipped.
    void stop() { skip_rest("the test was broken off"); }
    /// Every step was gone through or left out beforehand: nobody broke the test off, and the
    /// device was there to the end.
    [[nodiscard]] bool is_finished() const { return at_ == steps_.size() && !is_cut_short_; }

private:
    using Step = std::variant<ReadStep, CalibrateStep, ForceStep, CableStep>;
    struct Planned {
        std::string_view name;
        Step step;
        std::string why_not; // "": it is done
    };

    void skip_to_next();
    void skip_rest(std::string_view why);

    std::vector<Planned> steps_;
    std::size_t at_ = 0;
    bool is_cut_short_ = false;
    std::vector<Outcome> outcomes_;
};

} // namespace hapnet::peer::self_test

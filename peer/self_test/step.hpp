// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/value_kind.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::peer::self_test {

enum class Verdict : std::uint8_t { passed, failed, skipped };
constexpr auto names_of(base::Tag<Verdict> /*enum*/)
{
    return base::names("passed", "failed", "skipped");
}
using base::name_of;

/// The instruction for the person.
enum class Prompt : std::uint8_t {
    nothing,
    hold_still, // the step reads reports
    wait,       // the device is calibrating
    dock,
    sweep,
    undock,
    release_button,
    hold_button,
    keep_button, // the step applies force
    pull_cable,
};
/// Returns the text of a prompt for people; "" for nothing.
[[nodiscard]] std::string_view describe(Prompt prompt);

/// The result of a step, with its measurements.
struct Outcome {
    std::string_view step;
    Verdict verdict = Verdict::skipped;
    std::string text;
    std::optional<double> rate_hz{};
    std::optional<base::Duration> gap_p50{};
    std::optional<base::Duration> gap_max{};
    std::optional<base::Duration> took{};
    std::optional<double> force_max_n{};
    std::optional<base::Duration> noticed_after{};
    std::string drawing{}; // lines of text, or ""
};
constexpr auto fields_of(base::Tag<Outcome>)
{
    using O = Outcome;
    return base::fields(
        "step", base::member("step", &O::step, "The name of the step."),
        base::member("verdict", &O::verdict, "`passed`, `failed` or `skipped`."),
        base::member("text", &O::text, "What was found, for a person."),
        base::member("rate_hz", &O::rate_hz, "Reports of the device in a second.")
            .left_out_if_none(),
        base::member("gap_p50_ms", &O::gap_p50, "The median of the times between two reports.")
            .left_out_if_none(),
        base::member("gap_max_ms", &O::gap_max, "The longest of them.").left_out_if_none(),
        base::member("took_s", &O::took, "How long the calibration took.").left_out_if_none(),
        base::member("force_max_n", &O::force_max_n, "The largest force.").left_out_if_none(),
        base::member("noticed_after_ms", &O::noticed_after,
                     "How long after the last report the loss of the cable was noticed.")
            .left_out_if_none());
}

/// The input of a step in a tick.
struct StepInput {
    device::Sample sample;
    device::CalibrationStep calibration = device::CalibrationStep::done;
    base::Force applied; // force of the previous tick, at the hand
};

/// The request of a step to the device for a tick.
struct StepRequest {
    base::Force wanted{};
    bool permitted = false;
    bool is_done = false;
    Prompt prompt = Prompt::nothing;
};

} // namespace hapnet::peer::self_test

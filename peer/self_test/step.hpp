// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

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
    hold_still, // it reads
    wait,       // the device is at it
    dock,
    sweep,
    undock,
    release_button,
    hold_button,
    keep_button, // the force comes
    pull_cable,
};
/// For a person; "" for nothing.
[[nodiscard]] std::string_view describe(Prompt prompt);

/// A measured number; its name ends in its unit.
struct Figure {
    std::string_view name;
    double value = 0.0;
};

/// The result of a step.
struct Outcome {
    std::string_view step;
    Verdict verdict = Verdict::skipped;
    std::string text;
    std::vector<Figure> figures{};
    std::string drawing{}; // lines of text, or ""
};

/// The input of a step in a tick.
struct StepInput {
    device::Sample sample;
    device::CalibrationStep calibration = device::CalibrationStep::done;
    base::Force applied; // of the tick before, at the hand
};

/// The request of a step to the device in a tick.
struct StepRequest {
    base::Force wanted{};
    bool permitted = false;
    bool is_done = false;
    Prompt prompt = Prompt::nothing;
};

} // namespace hapnet::peer::self_test

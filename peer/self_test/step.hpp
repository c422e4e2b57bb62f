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
[[nodiscard]] std::string_view name_of(Verdict verdict);

/// What the person is to do now.
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
[[nodiscard]] std::string_view words_for(Prompt prompt);

/// A number that was found, with its unit at the end of its name.
struct Figure {
    std::string_view name;
    double value = 0.0;
};

/// How a step went.
struct Outcome {
    std::string_view step;
    Verdict verdict = Verdict::skipped;
    std::string text;
    std::vector<Figure> figures{};
    std::string drawing{}; // lines of text, or ""
};

/// What a step is told in a tick.
struct Feeling {
    device::Sample sample;
    device::CalibrationStep calibration = device::CalibrationStep::done;
    base::Force applied; // of the tick before, at the hand
};

/// What a step wants of the device in a tick.
struct Turn {
    base::Force wanted{};
    bool permitted = false;
    bool is_done = false;
    Prompt prompt = Prompt::nothing;
};

} // namespace hapnet::peer::self_test

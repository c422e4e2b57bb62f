// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/device.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::device {

namespace {

constexpr std::string_view calibration_failed =
    "the calibration failed: check the cable and power, calibrate it with its vendor's program if "
    "it has one, and start again";

} // namespace

std::string_view describe(CalibrationStep step)
{
    switch (step) {
    case CalibrationStep::done: return "";
    case CalibrationStep::busy: return "the device calibrates itself";
    case CalibrationStep::dock_stylus: return "put the stylus into its holder to calibrate";
    case CalibrationStep::sweep_joints:
        return "move the grip slowly through its whole reach, to every stop, to calibrate";
    case CalibrationStep::failed: return calibration_failed;
    }
    return calibration_failed;
}

std::string description(const Device& device)
{
    const Identity& identity = device.identity();
    const std::string address =
        identity.serial.empty() ? identity.backend : identity.backend + " " + identity.serial;
    if (identity.note.empty()) return fmt::format("{}: {}", address, identity.model);
    return fmt::format("{}: {} ({})", address, identity.model, identity.note);
}

} // namespace hapnet::device

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "peer/loop/evdev_switch.hpp"

#include <utility>
#include <variant>

namespace hapnet::peer::loop {

/// The device's own buttons as a dead man's switch: any of them.
struct DeviceButton {};

/// A dead man's switch: there is force only while a person holds it. Without one there always is.
class DeadMan {
public:
    DeadMan() = default;
    explicit DeadMan(DeviceButton button) : source_{button} {}
    explicit DeadMan(EvdevSwitch input) : source_{std::move(input)} {}

    [[nodiscard]] bool is_asked_for() const
    {
        return !std::holds_alternative<std::monostate>(source_);
    }

    /// True if it is held now. A device at fault says nothing, and nothing is held.
    [[nodiscard]] bool is_held(const device::Sample& sample)
    {
        if (auto* input = std::get_if<EvdevSwitch>(&source_)) return input->is_held();
        if (!is_asked_for()) return true;
        return sample.fault == device::Fault::none && (sample.gripping || sample.buttons != 0);
    }

private:
    std::variant<std::monostate, DeviceButton, EvdevSwitch> source_;
};

} // namespace hapnet::peer::loop

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "peer/loop/evdev_switch.hpp"

#include <utility>
#include <variant>

namespace hapnet::peer::loop {

/// The buttons of the device as a dead man's switch. Any of them will do.
struct DeviceButton {};

/// A dead man's switch: there is force only while a person holds it. Without a switch, force is
/// always allowed.
class DeadMan {
public:
    DeadMan() = default;
    explicit DeadMan(DeviceButton button) : source_{button} {}
    explicit DeadMan(EvdevSwitch input) : source_{std::move(input)} {}

    [[nodiscard]] bool is_asked_for() const
    {
        return !std::holds_alternative<std::monostate>(source_);
    }

    /// True if the switch is held now. A faulty device reports no button, so the switch counts as
    /// released.
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

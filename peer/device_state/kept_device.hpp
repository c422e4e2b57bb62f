// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "peer/device_state/state.hpp"

#include <string>

namespace hapnet::peer::device_state {

/// The stored state of one real device, in $XDG_STATE_HOME/hapnet/device/NAME.json or below
/// ~/.local/state. It is read at the start, and written at once (mode 0600) whenever it changes. An
/// unreadable file counts as missing. A file that cannot be written is reported, and the session
/// continues.
class KeptDevice {
public:
    KeptDevice(const device::Identity& identity, std::string_view place);

    /// Returns the present result of device_state::why_untested() for this device.
    [[nodiscard]] std::string_view why_untested() const;
    [[nodiscard]] double heat_at_start(base::Duration heat_time) const;

    /// Notes that the motors are about to be used. Their heat is then unknown until on_rest(), also
    /// if the program dies.
    void on_use();
    void on_rest(double heat);
    /// Notes that the device has just passed a self-test.
    void on_passed();

    [[nodiscard]] const std::string& path() const { return path_; }

private:
    void save();

    std::string path_; // path of the file; "": there is no folder for it
    DeviceState state_;
};

} // namespace hapnet::peer::device_state

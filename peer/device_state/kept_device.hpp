// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "peer/device_state/state.hpp"

#include <string>

namespace hapnet::peer::device_state {

/// The state of one real device in its file, $XDG_STATE_HOME/hapnet/device/NAME.json, or below
/// ~/.local/state: read at the start, and written at once (mode 0600) whenever it changes. A file
/// that cannot be read counts as missing. One that cannot be written is reported, and the session
/// goes on.
class KeptDevice {
public:
    KeptDevice(const device::Identity& identity, std::string_view place);

    /// The result of device_state::why_untested() for its state, for now.
    [[nodiscard]] std::string_view why_untested() const;
    [[nodiscard]] double heat_at_start(base::Duration heat_time) const;

    /// Call it before motors are used. Their heat is then unknown until on_rest(), also if the
    /// program dies.
    void on_use();
    void on_rest(double heat);
    /// The device has passed a self-test, now.
    void on_passed();

    [[nodiscard]] const std::string& path() const { return path_; }

private:
    void save();

    std::string path_; // file of the state; "": there is no folder for it
    DeviceState state_;
};

} // namespace hapnet::peer::device_state

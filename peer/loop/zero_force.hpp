// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/loop/watchdog.hpp"

namespace hapnet::peer::loop {

/// Sends zero force to the device on every way out of a loop's scope, three times because one
/// message may be lost on the wire, and ends the watchdog's monitoring of the loop.
class ZeroForceAtTheEnd {
public:
    ZeroForceAtTheEnd(device::Device& device, Watchdog& watchdog)
        : device_{device}, watchdog_{watchdog}
    {}
    ~ZeroForceAtTheEnd()
    {
        for (int i = 0; i < repeats; ++i) device_.apply({});
        watchdog_.rest();
    }
    ZeroForceAtTheEnd(const ZeroForceAtTheEnd&) = delete;
    ZeroForceAtTheEnd& operator=(const ZeroForceAtTheEnd&) = delete;

    static constexpr int repeats = 3;

private:
    device::Device& device_;
    Watchdog& watchdog_;
};

} // namespace hapnet::peer::loop

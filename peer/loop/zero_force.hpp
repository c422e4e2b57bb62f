// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "peer/loop/watchdog.hpp"

namespace hapnet::peer::loop {

/// Acts on every way out of a loop's scope: tells the device zero force, three times because a wire
/// may lose one, and ends the watch over the loop.
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

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/net/clock.hpp"
#include "tests/support/falcon/fake_falcon.hpp"

namespace hapnet::conformance {

/// A testbed with a fake Falcon on its bus, and a person who holds its grip in the middle.
struct EmulatedFalcon {
    explicit EmulatedFalcon(std::string kernel_driver = "")
        : usb{testbed, description(std::move(kernel_driver)), falcon}
    {
        falcon.want(base::Position{});
    }

    [[nodiscard]] static umockdev::UsbDescription description(std::string kernel_driver)
    {
        auto usb = test::usb_of_falcon("FALC0001");
        usb.kernel_driver = std::move(kernel_driver);
        return usb;
    }

    umockdev::Testbed testbed;
    test::FakeFalcon falcon{net::monotonic_now};
    umockdev::UsbDevice usb;
};

} // namespace hapnet::conformance

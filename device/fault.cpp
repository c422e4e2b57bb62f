// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/fault.hpp"

namespace hapnet::device {

namespace {

constexpr std::string_view driver_failed =
    "the device's driver failed: unplug it, plug it in again, and start again";

} // namespace

std::string_view describe(Fault fault)
{
    switch (fault) {
    case Fault::none: return "";
    case Fault::not_found:
        return "no such device: check its cable and power; hapnet-peer list-devices shows what is "
               "connected";
    case Fault::permission:
        return "no permission to use the device: install the udev rules (hapnet-peer doctor says "
               "how), then unplug it and plug it in again";
    case Fault::in_use: return "another program uses the device: end that one first";
    case Fault::firmware_missing:
        return "the device needs firmware from its vendor: give it as a file";
    case Fault::library_missing:
        return "the device needs its vendor's library: install it, or name it with --hd-library";
    case Fault::communication:
        return "the device sent data that makes no sense: check its cable, and use no hub";
    case Fault::timeout: return "the device does not answer: check its cable and power";
    case Fault::overheat: return "a motor of the device is hot: let it cool down";
    case Fault::over_force:
        return "the device was asked for more force than it has: use a lower --force-limit";
    case Fault::over_velocity: return "it was moved too fast, or was let go under force";
    case Fault::not_calibrated: return "the device has lost its calibration: calibrate it again";
    case Fault::disconnected: return "the device has gone: plug it in and start again";
    case Fault::internal: return driver_failed;
    }
    return driver_failed;
}

} // namespace hapnet::device

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/governor/trip.hpp"

namespace hapnet::device {

std::string_view what_happened(const Latched& latched)
{
    switch (latched.trip) {
    case Trip::loop:
        return "this program stood still for more than 100 ms: end what keeps the machine busy, or "
               "give it real-time priority";
    case Trip::jump:
        return "its position jumped: check the cable, and calibrate again if the positions are off";
    case Trip::nonsense:
        return "the device reports positions that are not numbers: check its cable, and start "
               "again";
    case Trip::frozen:
        return "its position stays the same however it is pushed: its encoders do not count; check "
               "the cable, and run the self-test";
    case Trip::runaway:
        return "it sped up against its own force: its motors or encoders have the wrong sign; do "
               "not use it before a self-test has passed";
    case Trip::none:
    case Trip::device:
    case Trip::silence:
    case Trip::speed: return describe(latched.fault);
    }
    return describe(latched.fault);
}

} // namespace hapnet::device

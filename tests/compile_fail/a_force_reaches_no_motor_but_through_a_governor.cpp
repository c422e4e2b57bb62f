// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/device.hpp"
#include "device/governor.hpp"

using namespace hapnet;

void push(device::Device& device, device::Governor& governor, const device::Sample& sample,
          base::TimePoint now)
{
    const base::Force wanted{{1.0, 0.0, 0.0}};
#ifdef MUST_COMPILE
    device.apply(governor.govern({wanted, true}, sample, now));
#else
    device.apply(device::GovernedForce{wanted});
#endif
}

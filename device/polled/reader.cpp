// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/polled/reader.hpp"

namespace hapnet::device::polled {

const Sample& Reader::read(const Report& report, base::TimePoint now)
{
    if (!heard_) heard_ = now;
    if (report.cycle > sample_.sequence) {
        take(report, now);
    } else if (now - *heard_ > silence_max) {
        sample_.fault = Fault::timeout;
    }
    return sample_;
}

void Reader::take(const Report& report, base::TimePoint now)
{
    heard_ = now;
    sample_.sequence = report.cycle;
    sample_.calibrated = report.calibrated;
    sample_.fault = report.fault;
    buttons_.update(report.buttons, now);
    buttons_.tell(sample_);
    if (sample_.fault != Fault::none) return; // the last position stays
    if (!base::is_finite(report.hip) || !base::is_finite(report.velocity)) {
        sample_.fault = Fault::communication;
        return;
    }
    sample_.hip = report.hip;
    sample_.velocity = report.velocity;
}

} // namespace hapnet::device::polled

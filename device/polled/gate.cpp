// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/polled/gate.hpp"

namespace hapnet::device::polled {

Command Gate::pass(const Command& newest, bool is_new, base::TimePoint now)
{
    if (is_new) given_ = now;
    const bool is_fresh = given_ && now - *given_ <= fresh_for;
    if (!is_fresh || !is_trusted_ || !newest.motors_on || !base::is_finite(newest.force)) return {};
    return newest;
}

std::optional<Report> Gate::heard(std::optional<Report> report, base::TimePoint now)
{
    if (report && report->fault != Fault::none) {
        fault_ = report->fault;
        fault_at_ = now;
    } else if (report && fault_ != Fault::none && now - fault_at_ <= fault_held_for) {
        report->fault = fault_;
    }
    is_trusted_ = report && report->calibrated && report->fault == Fault::none;
    return report;
}

} // namespace hapnet::device::polled

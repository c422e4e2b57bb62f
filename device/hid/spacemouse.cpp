// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/spacemouse.hpp"

#include "device/hid/pid_layout.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace hapnet::device::hid {

namespace {

double speed_of(int deflection)
{
    if (std::abs(deflection) < SpaceMouse::deflection_least) return 0.0;
    const double share = static_cast<double>(deflection) / SpaceMouse::deflection_full;
    return SpaceMouse::speed_max_m_per_s * std::clamp(share, -1.0, 1.0);
}

} // namespace

SpaceMouse::SpaceMouse(Identity identity, std::unique_ptr<Wire> wire)
    : identity_{std::move(identity)}, wire_{std::move(wire)}
{
    base::ensure(wire_ != nullptr);
    capabilities_.axes_out = 0;
    capabilities_.buttons = 2;
    capabilities_.speed_max_m_per_s = 1.0;
}

Sample SpaceMouse::read(base::TimePoint now)
{
    const base::Duration passed =
        read_at_ ? std::min(now - *read_at_, pause_max) : base::Duration{0};
    read_at_ = now;
    move(passed); // by the cap's displacement until now
    if (!is_gone_) drain(now);
    if (now - deflected_at_ > deflection_lasts || is_gone_) speed_ = {};
    buttons_.update(buttons_down_, now);
    buttons_.tell(sample_);
    sample_.fault = is_gone_      ? Fault::disconnected
                    : is_garbled_ ? Fault::communication
                                  : Fault::none;
    return sample_;
}

void SpaceMouse::move(base::Duration passed)
{
    const glm::dvec3 before = sample_.hip.value;
    const glm::dvec3 wanted = before + speed_ * base::to_seconds(passed);
    for (const int axis : {0, 1, 2}) {
        sample_.hip.value[axis] = std::clamp(wanted[axis], capabilities_.workspace_min.value[axis],
                                             capabilities_.workspace_max.value[axis]);
    }
    if (passed > base::Duration{0}) {
        sample_.velocity = {(sample_.hip.value - before) / base::to_seconds(passed)};
    }
}

void SpaceMouse::drain(base::TimePoint now)
{
    std::array<std::byte, report_bytes_max> report{};
    for (int i = 0; i < reports_per_read_max; ++i) {
        const ReadResult heard = wire_->read(report);
        if (heard.moved == TransferResult::nothing) return;
        if (heard.moved != TransferResult::yes) {
            is_gone_ = true; // a read fails only if the device has gone
            return;
        }
        on_report(std::span{report}.first(heard.size), now);
    }
}

void SpaceMouse::on_report(std::span<const std::byte> report, base::TimePoint now)
{
    const auto word = read_spacemouse(report);
    is_garbled_ = !word;
    if (!word) {
        speed_ = {};
        return;
    }
    ++sample_.sequence;
    if (word->deflection) {
        const glm::ivec3& cap = *word->deflection;
        speed_ = {speed_of(cap.x), -speed_of(cap.z), speed_of(cap.y)};
        deflected_at_ = now;
    }
    if (word->buttons) buttons_down_ = *word->buttons;
}

} // namespace hapnet::device::hid

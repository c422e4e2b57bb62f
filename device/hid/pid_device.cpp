// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/pid_device.hpp"

#include "device/hid/field.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hapnet::device::hid {

namespace {

// Assumptions for unknown motors: a continuous force of half their cap, and a stiffness that stays
// stable at a delay of some milliseconds with the free hand of a simulation.
constexpr double continuous_share = 0.5;
constexpr double stiffness_n_per_m = 400.0;
constexpr double damping_ns_per_m = 4.0;
constexpr double speed_m_per_s = 1.0;

Capabilities capabilities_of(const PidParts& parts)
{
    const auto& axes = parts.input.axes;
    const double reach = parts.options.reach_m;
    Capabilities can;
    can.workspace_min = {{-reach, axes.size() > 1 ? -reach : 0.0, 0.0}};
    can.workspace_max = {{reach, axes.size() > 1 ? reach : 0.0, 0.0}};
    can.axes_in = static_cast<int>(axes.size());
    can.axes_out = 0;
    can.buttons = static_cast<int>(parts.input.buttons.size());
    for (const Field& axis : axes) {
        const auto steps = static_cast<double>(axis.logical_max - axis.logical_min);
        can.resolution_m = std::max(can.resolution_m, 2.0 * reach / steps);
    }
    can.force_is_calibrated = false;
    can.speed_max_m_per_s = speed_m_per_s;
    if (parts.outbox && parts.options.force_full_n) {
        can.axes_out = can.axes_in;
        can.force_max_n =
            std::min(std::abs(*parts.options.force_full_n), parts.options.force_cap_n);
        can.force_continuous_n = continuous_share * can.force_max_n;
        can.stiffness_max_n_per_m = stiffness_n_per_m;
        can.damping_max_ns_per_m = damping_ns_per_m;
    }
    return can;
}

std::int16_t level_of(double share)
{
    const double limited = std::clamp(share, -1.0, 1.0);
    return static_cast<std::int16_t>(std::lround(limited * Order::level_full));
}

} // namespace

PidDevice::PidDevice(PidParts parts)
    : parts_{std::move(parts)}, capabilities_{capabilities_of(parts_)}
{
    base::ensure(parts_.wire != nullptr && !parts_.input.axes.empty());
}

PidDevice::~PidDevice()
{
    if (!parts_.outbox) return;
    parts_.outbox->mailbox().update([](Order& order) {
        order.levels = {};
        order.motors_on = false;
        order.is_last = true;
        ++order.stops;
    });
    parts_.outbox->wake();
}

Sample PidDevice::read(base::TimePoint now)
{
    const base::Duration passed =
        read_at_ ? std::min(now - *read_at_, pause_max) : base::Duration{0};
    read_at_ = now;
    silent_ += passed;
    is_garbled_ = was_garbled_;
    if (!is_gone_) drain();
    if (parts_.outbox) watch(passed);
    buttons_.update(buttons_down_, now);
    buttons_.tell(sample_);
    sample_.velocity = velocity_.at(sample_.hip, now);
    sample_.fault = fault();
    return sample_;
}

void PidDevice::drain()
{
    std::array<std::byte, report_bytes_max> report{};
    for (int i = 0; i < reports_per_read_max; ++i) {
        const ReadResult heard = parts_.wire->read(report);
        if (heard.moved == TransferResult::nothing) return;
        if (heard.moved != TransferResult::yes) {
            is_gone_ = true; // a read fails only if the device has gone
            return;
        }
        on_report(std::span{report}.first(heard.size));
    }
}

void PidDevice::on_report(std::span<const std::byte> report)
{
    if (parts_.input.place.id != 0) {
        if (report.empty() || report[0] != std::byte{parts_.input.place.id}) return;
        report = report.subspan(1);
    }
    std::array<double, 2> shares{};
    was_garbled_ = report.size() < parts_.input.place.bytes;
    for (std::size_t i = 0; i < parts_.input.axes.size(); ++i) {
        const auto value = unpack(parts_.input.axes[i], report);
        if (value) {
            shares.at(i) = share_of(parts_.input.axes[i], *value);
        } else {
            was_garbled_ = true;
        }
    }
    if (was_garbled_) {
        is_garbled_ = true;
        return;
    }
    sample_.hip = {{parts_.options.reach_m * shares[0], -parts_.options.reach_m * shares[1], 0.0}};
    buttons_down_ = 0;
    for (std::size_t i = 0; i < parts_.input.buttons.size(); ++i) {
        if (unpack(parts_.input.buttons[i], report).value_or(0) == 0) continue;
        buttons_down_ = static_cast<std::uint8_t>(buttons_down_ | (1U << i));
    }
    ++sample_.sequence;
    silent_ = {};
}

void PidDevice::watch(base::Duration passed)
{
    const Progress before = std::exchange(progress_, parts_.outbox->mailbox().progress());
    const bool moved = progress_.sent != before.sent;
    if (moved && silent_ >= probe_after) {
        ++sample_.sequence;
        silent_ = {};
    }
    unmoved_ = moved || !progress_.is_busy ? base::Duration{0} : unmoved_ + passed;
    if (moved) is_refusing_ = false;
    if (progress_.refused != before.refused) is_refusing_ = true;
    is_gone_ = is_gone_ || progress_.is_gone;
    probe(passed);
}

void PidDevice::probe(base::Duration passed)
{
    since_probed_ += passed;
    if (silent_ < probe_after || since_probed_ < probe_after) return;
    since_probed_ = {};
    parts_.outbox->mailbox().update([](Order& order) { ++order.probes; });
    parts_.outbox->wake();
}

Fault PidDevice::fault() const
{
    if (is_gone_) return Fault::disconnected;
    if (unmoved_ >= silence_max) return Fault::timeout;
    if (parts_.outbox && silent_ >= silence_max) return Fault::timeout;
    if (is_garbled_ || is_refusing_) return Fault::communication;
    return Fault::none;
}

void PidDevice::apply(const GovernedForce& force)
{
    if (capabilities_.axes_out == 0) return;
    const bool is_on = force.motors_on() && base::is_finite(force.force());
    const base::Force limited =
        is_on ? base::limited(force.force(), capabilities_.force_max_n) : base::Force{};
    const double full = *parts_.options.force_full_n;
    parts_.outbox->mailbox().update([&](Order& order) {
        order.levels = {level_of(limited.x() / full), level_of(limited.y() / full)};
        order.motors_on = is_on;
        if (is_on) ++order.number;
    });
    parts_.outbox->wake();
}

void PidDevice::halt() noexcept
{
    if (!parts_.outbox) return;
    parts_.outbox->mailbox().update([](Order& order) {
        order.levels = {};
        order.motors_on = false;
        ++order.stops;
    });
    parts_.outbox->wake();
}

} // namespace hapnet::device::hid

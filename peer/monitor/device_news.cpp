// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/device_news.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::peer::monitor {

namespace {

std::string_view way_back(const DeviceNews& news)
{
    using device::Fault;
    const Fault fault = news.fault.fault;
    const bool needs_a_restart = fault == Fault::disconnected || fault == Fault::not_found ||
                                 news.fault.trip == device::Trip::nonsense;
    if (needs_a_restart) return "";
    if (news.recovery.by_simulated_hand) {
        return "; the simulated hand holds still for a second, then presses the button";
    }
    if (news.recovery.by_holder) {
        return "; to feel force again put the stylus into its holder, or hold it still for a "
               "second and then its button for half a second";
    }
    if (news.recovery.by_button) {
        return "; to feel force again hold it still for a second, then hold its primary button for "
               "half a second";
    }
    return "; to feel force again start this program again, as the device has no button";
}

} // namespace

Recovery recovery_of(const device::Device& device)
{
    const device::Capabilities& can = device.capabilities();
    return {.by_holder = can.has_holder,
            .by_button = can.buttons > 0,
            .by_simulated_hand = device.identity().backend == "sim"};
}

std::string describe(const DeviceNews& news)
{
    if (news.change == DeviceChange::energy) return ""; // the final summary reports it
    if (news.change == DeviceChange::calibration) {
        if (news.calibration == device::CalibrationStep::done) return "the device is calibrated";
        return std::string{device::describe(news.calibration)};
    }
    if (news.fault.fault == device::Fault::none) return "the device is well again: force ramps in";
    return fmt::format("zero force ({}): {}{}", device::name_of(news.fault.fault),
                       device::what_happened(news.fault), way_back(news));
}

std::string fault_at_the_end(const device::Governor& governor)
{
    const device::Latched& fault = governor.fault();
    if (fault.fault == device::Fault::none) return "";
    return fmt::format("the session ended at zero force, for a fault of the device ({}): {}",
                       device::name_of(fault.fault), device::what_happened(fault));
}

bool DeviceReporter::is_time(std::optional<base::TimePoint>& last, base::TimePoint now) const
{
    if (last && now - *last < at_most_every) return false;
    last = now;
    return true;
}

std::optional<DeviceNews> DeviceReporter::look(device::CalibrationStep calibration,
                                               const device::Latched& fault, base::TimePoint now)
{
    if (!(fault == told_.fault) && is_time(fault_told_, now)) {
        told_.fault = fault;
        DeviceNews news = told_;
        news.change = DeviceChange::fault;
        return news;
    }
    if (calibration != told_.calibration && is_time(calibration_told_, now)) {
        told_.calibration = calibration;
        DeviceNews news = told_;
        news.change = DeviceChange::calibration;
        return news;
    }
    return std::nullopt;
}

std::optional<DeviceNews> DeviceReporter::look_at_energy(std::uint64_t limited_ticks,
                                                         base::TimePoint now)
{
    if (limited_ticks == told_.energy_limited_ticks || !is_time(energy_told_, now))
        return std::nullopt;
    told_.energy_limited_ticks = limited_ticks;
    DeviceNews news = told_;
    news.change = DeviceChange::energy;
    return news;
}

} // namespace hapnet::peer::monitor

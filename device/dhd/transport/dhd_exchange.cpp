// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/dhd/transport/dhd_exchange.hpp"

#include <tuple>

namespace hapnet::device::dhd {

DhdExchange::~DhdExchange()
{
    std::ignore = functions_.set_force(0.0, 0.0, 0.0, device_);
    std::ignore = functions_.enable_force(0, device_);
    std::ignore = functions_.close(device_);
}

std::optional<polled::Report> DhdExchange::tell(const polled::Command& command)
{
    Reading reading;
    reading.result = send(command);
    if (reading.result >= 0) reading.result = receive(reading);
    if (reading.result < 0) reading.error = functions_.last_error();
    return interpreter_.report_of(reading, command.motors_on);
}

int DhdExchange::send(const polled::Command& command)
{
    const auto force = to_library(command.force.value);
    if (motors_on_ != command.motors_on) {
        const int switched = functions_.enable_force(command.motors_on ? 1 : 0, device_);
        if (switched < 0) return switched;
        motors_on_ = command.motors_on;
    }
    return functions_.set_force(force[0], force[1], force[2], device_);
}

int DhdExchange::receive(Reading& reading) const
{
    auto& [x, y, z] = reading.position;
    if (const int result = functions_.get_position(&x, &y, &z, device_); result < 0) return result;
    auto& [vx, vy, vz] = reading.velocity;
    if (const int result = functions_.get_velocity(&vx, &vy, &vz, device_); result < 0) {
        return result;
    }
    reading.buttons = functions_.get_button(0, device_) == 1 ? 1 : 0;
    return functions_.get_status(reading.status.data(), device_);
}

} // namespace hapnet::device::dhd

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/omni1394/start_sequence.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::device::omni1394 {

namespace {

RegisterAccess read_of(std::uint64_t address, std::size_t size)
{
    return {.address = address, .size = size};
}

RegisterAccess write_of(std::uint64_t address, std::byte value)
{
    return {.address = address, .size = 1, .writes = true, .bytes = {value}};
}

} // namespace

std::optional<RegisterAccess> StartSequence::next() const
{
    switch (step_) {
    case Step::model: return read_of(model_register, 4);
    case Step::serial: return read_of(serial_register, 4);
    case Step::to_device_channel:
        return write_of(to_device_channel_register, std::byte{channels_.to_device});
    case Step::to_host_channel:
        return write_of(to_host_channel_register, std::byte{channels_.to_host});
    case Step::to_host_channel_again: return read_of(to_host_channel_register, 1);
    case Step::dubious:
        return RegisterAccess{
            .address = dubious_register, .size = 4, .writes = true, .bytes = dubious_value};
    case Step::control: return read_of(control_register, 1);
    case Step::stream: return write_of(control_register, control_ | control_streaming_bit);
    case Step::done:
    case Step::failed: return std::nullopt;
    }
    return std::nullopt;
}

void StartSequence::on_answer(std::span<const std::byte> bytes)
{
    const auto access = next();
    if (!access) return;
    if (!access->writes && bytes.size() != access->size) {
        return fail(fmt::format("register {:#x} gives {} bytes and not {}", access->address,
                                bytes.size(), access->size));
    }
    switch (step_) {
    case Step::model:
        if (quadlet_of(bytes) != model_value) {
            return fail(fmt::format("its register {:#x} holds {:#010x} and not {:#010x}: it is no "
                                    "PHANToM Omni",
                                    model_register, quadlet_of(bytes), model_value));
        }
        return go_to(Step::serial);
    case Step::serial:
        serial_ = serial_of(quadlet_of(bytes));
        return go_to(Step::to_device_channel);
    case Step::to_device_channel: return go_to(Step::to_host_channel);
    case Step::to_host_channel: return go_to(Step::to_host_channel_again);
    case Step::to_host_channel_again:
        if (bytes.front() != std::byte{channels_.to_host}) {
            return fail(fmt::format("it was told channel {} and says {}", channels_.to_host,
                                    std::to_integer<int>(bytes.front())));
        }
        return go_to(writes_dubious_register_ ? Step::dubious : Step::control);
    case Step::dubious: return go_to(Step::control);
    case Step::control: control_ = bytes.front(); return go_to(Step::stream);
    case Step::stream: return go_to(Step::done);
    case Step::done:
    case Step::failed: return;
    }
}

void StartSequence::fail(std::string why)
{
    failure_ = std::move(why);
    step_ = Step::failed;
}

RegisterAccess stop_streaming() { return write_of(control_register, std::byte{0}); }

} // namespace hapnet::device::omni1394

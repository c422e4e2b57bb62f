// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/omni1394/fake_omni.hpp"

#include "device/omni1394/registers.hpp"
#include "device/simulated/minimum_jerk.hpp"

#include <algorithm>
#include <chrono>

namespace hapnet::device::omni1394 {

namespace {

std::vector<std::byte> big_endian(std::uint32_t quadlet)
{
    std::vector<std::byte> bytes;
    for (const unsigned shift : {24U, 16U, 8U, 0U}) bytes.push_back(std::byte(quadlet >> shift));
    return bytes;
}

constexpr base::Duration walk{std::chrono::seconds{1}};

} // namespace

FakeOmni::FakeOmni(bool begins_docked, std::uint32_t serial)
    : registers_{{to_device_channel_register, {std::byte{0}}},
                 {to_host_channel_register, {std::byte{0}}},
                 {control_register, {std::byte{0x20}}},
                 {dubious_register, {4, std::byte{0}}},
                 {model_register, big_endian(model_value)},
                 {serial_register, big_endian(serial)}},
      plant_{{.begins_docked = begins_docked}},
      from_{plant_.tip()},
      to_{plant_.tip()},
      walked_{walk}
{}

std::optional<std::vector<std::byte>> FakeOmni::read_register(std::uint64_t address,
                                                              std::size_t size) const
{
    const auto found = registers_.find(address);
    if (found == registers_.end() || found->second.size() != size) return std::nullopt;
    return found->second;
}

bool FakeOmni::write_register(std::uint64_t address, std::span<const std::byte> bytes)
{
    const auto found = registers_.find(address);
    if (found == registers_.end() || found->second.size() != bytes.size()) return false;
    found->second.assign(bytes.begin(), bytes.end());
    written_.push_back(address);
    return true;
}

bool FakeOmni::is_streaming() const
{
    return (registers_.at(control_register).front() & control_streaming_bit) != std::byte{0};
}

void FakeOmni::hear(std::span<const std::byte> bytes)
{
    if (stalls_) return;
    const auto packet = decode_host(bytes);
    heard_.push_back(packet);
    const bool pushes = packet && packet->motors_on;
    plant_.set_torque(pushes ? torque_of(packet->motors) : glm::dvec3{0.0});
}

std::vector<std::byte> FakeOmni::live(base::Duration elapsed)
{
    const base::Position before =
        from_ + minimum_jerk(base::to_seconds(walked_) / base::to_seconds(walk)) * (to_ - from_);
    walked_ = std::min(walked_ + elapsed, walk);
    const base::Position after =
        from_ + minimum_jerk(base::to_seconds(walked_) / base::to_seconds(walk)) * (to_ - from_);
    plant_.set_grip(Grip{before, {(after - before).value / base::to_seconds(elapsed)}, {}});
    plant_.advance(elapsed);
    ++message_;
    ++number_;
    if (!is_streaming() || stalls_) return {};
    if (garbles_) return std::vector<std::byte>(48, std::byte(0x5a + message_ % 7));
    DevicePacket packet;
    packet.counts = plant_.counts() + off_;
    packet.number = number_;
    packet.buttons = buttons_;
    packet.docked = plant_.is_docked();
    packet.message = message_;
    const DeviceBytes bytes = encode(packet);
    return {bytes.begin(), bytes.end()};
}

void FakeOmni::lead_to(const base::Position& place)
{
    from_ = to_;
    to_ = place;
    walked_ = base::Duration{0};
}

} // namespace hapnet::device::omni1394

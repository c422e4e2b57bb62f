// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/omni1394/packet.hpp"
#include "device/simulated/joints/plant.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::device::omni1394 {

/// A double of a FireWire Omni behind its bus: registers, a mechanism, and a hand. It follows
/// public descriptions, and proves nothing about the device.
class FakeOmni {
public:
    /// One of the serial numbers is that of the quadlet 0x83a6d80e, which was observed.
    explicit FakeOmni(bool begins_docked = true, std::uint32_t serial = 0x83a6d80e);

    // The bus. nullopt and false: there is no such register.
    [[nodiscard]] std::optional<std::vector<std::byte>> read_register(std::uint64_t address,
                                                                      std::size_t size) const;
    [[nodiscard]] bool write_register(std::uint64_t address, std::span<const std::byte> bytes);
    [[nodiscard]] bool is_streaming() const;
    /// Takes a packet from the host.
    void hear(std::span<const std::byte> bytes);
    /// Advances its time. Returns its next packet; nothing when it does not stream or has stalled.
    [[nodiscard]] std::vector<std::byte> live(base::Duration elapsed);

    // States and events. The hand goes there within a second, and stays.
    void lead_to(const base::Position& place);
    void press(std::uint8_t buttons) { buttons_ = buttons; }
    void stall(bool on) { stalls_ = on; }
    void garble(bool on) { garbles_ = on; }
    /// Shifts the encoders from now on.
    void jump(const omni::Counts& counts) { off_ += counts; }
    void skip(std::uint32_t messages) { message_ += messages; }

    /// Returns the packets received; nullopt for those that could not be decoded.
    [[nodiscard]] const std::vector<std::optional<HostPacket>>& heard() const { return heard_; }
    [[nodiscard]] std::span<const std::uint64_t> written() const { return written_; }
    [[nodiscard]] const JointPlant& plant() const { return plant_; }

    /// Returns the torque of motor counts, N m, as the driver estimates it.
    [[nodiscard]] static glm::dvec3 torque_of(const glm::ivec3& motors)
    {
        return omni::torque_max_nm * glm::dvec3{motors} / double{motor_max};
    }

private:
    std::map<std::uint64_t, std::vector<std::byte>> registers_;
    std::vector<std::uint64_t> written_; // addresses
    JointPlant plant_;
    base::Position from_;
    base::Position to_;
    base::Duration walked_{};
    std::uint8_t buttons_ = 0;
    bool stalls_ = false;
    bool garbles_ = false;
    omni::Counts off_{0};
    std::uint32_t message_ = 0x00ffff00; // it has counted since its power came on
    std::uint8_t number_ = 0;
    std::vector<std::optional<HostPacket>> heard_;
};

} // namespace hapnet::device::omni1394

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/falcon/kinematics.hpp"
#include "device/falcon/packet.hpp"
#include "proto/base/space.hpp"
#include "proto/base/time.hpp"
#include "tests/support/umockdev/usb_device.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::test {

/// Returns the device's description on the bus.
[[nodiscard]] umockdev::UsbDescription usb_of_falcon(const std::string& serial, int address = 2);

/// A double of a Falcon and of the person who holds it, as far as public sources describe the
/// device: the FTDI chip, the loader, the firmware's packets, homing, and a grip that obeys motors
/// and hand. It shows that the backend keeps to that description, not that the description is
/// right.
class FakeFalcon final : public umockdev::UsbModel {
public:
    /// A firmware of our own making, which it takes for Novint's.
    [[nodiscard]] static const std::vector<std::byte>& firmware();
    /// The clock of a device that cannot read one itself. It never runs backwards.
    using Clock = std::function<base::TimePoint()>;

    explicit FakeFalcon(Clock clock);

    // Events of the device.
    void lose_firmware() { stage_ = Stage::cold; }          // as when its power was cut
    void spoil_loads(int count) { spoiled_loads_ = count; } // the next `count` loads fail
    void garble(bool on) { is_garbling_ = on; }             // it answers in nonsense
    void lose_homing() { legs_homed_ = 0; }
    void press(std::uint8_t buttons) { buttons_ = buttons; } // as in Report

    // The person. Pushes the grip to every stop when the device requests it.
    void help_homing() { helps_homing_ = true; }
    /// Moves the grip there at 0.2 m/s at most; nullopt: releases it.
    void want(std::optional<base::Position> place) { wanted_ = place; }

    // Returns the commands that it received.
    [[nodiscard]] const std::vector<device::falcon::Command>& commands() const { return commands_; }
    /// Returns the time of its last command with a torque.
    [[nodiscard]] base::TimePoint last_push() const { return last_push_; }
    [[nodiscard]] base::Position grip() const { return grip_; }
    [[nodiscard]] base::Force force() const { return force_; } // of the motors at the grip
    [[nodiscard]] int loads() const { return loads_; }         // attempts
    [[nodiscard]] bool is_running() const { return stage_ == Stage::running; }

    [[nodiscard]] std::optional<std::vector<std::byte>>
    on_control(const umockdev::UsbSetup& setup, std::span<const std::byte> data) override;
    void on_bulk_out(std::span<const std::byte> bytes) override;
    [[nodiscard]] std::optional<std::vector<std::byte>> on_bulk_in(std::size_t size) override;

private:
    enum class Stage : std::uint8_t { cold, greeted, loading, running };

    void load(std::byte byte);
    void obey(const device::falcon::Command& command);
    void live_until(base::TimePoint now);
    void step(double seconds);
    void move_aim(double seconds);
    [[nodiscard]] device::falcon::Report report();

    Clock clock_;
    Stage stage_ = Stage::running;
    unsigned baud_ = 0;
    base::Duration latency_{std::chrono::milliseconds{16}};
    base::TimePoint last_answer_{};
    std::deque<std::byte> to_host_;
    std::vector<std::byte> from_host_; // in the loader
    device::falcon::PacketFinder finder_;
    std::vector<device::falcon::Command> commands_;
    device::falcon::Command command_;
    base::TimePoint last_push_{};
    base::TimePoint lived_until_{};

    base::Position grip_{};
    base::Velocity velocity_{};
    base::Force force_{};
    device::falcon::Counts power_up_; // the encoders' counts at power-up
    std::uint8_t legs_homed_ = 0;
    std::uint8_t buttons_ = 0;
    std::optional<base::Position> wanted_;
    std::optional<base::Position> aim_; // the hand's aim on its way there
    bool helps_homing_ = false;
    bool is_garbling_ = false;
    int spoiled_loads_ = 0;
    int loads_ = 0;
};

} // namespace hapnet::test

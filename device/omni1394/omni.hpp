// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/omni/tracker.hpp"
#include "device/omni1394/drive.hpp"
#include "device/omni1394/link.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace hapnet::device::omni1394 {

/// The PHANToM Omni with FireWire; written from descriptions, never run on the physical device.
/// Without a measured table of torques it sends no force, unless uncalibrated force is requested:
/// then it sends at most a quarter of the motors' full range. It is unknown whether the device has
/// a watchdog. Its reaction when this program is killed is therefore unknown, too; it gets no more
/// packets then.
class Omni final : public Device {
public:
    /// Runs the start sequence. Returns the device once it has started, or the reason why it has
    /// not.
    [[nodiscard]] static Opened<std::unique_ptr<Device>> open(std::unique_ptr<Link> link,
                                                              const Profile& profile, Use use);
    ~Omni() override;
    Omni(const Omni&) = delete;
    Omni& operator=(const Omni&) = delete;

    [[nodiscard]] const Identity& identity() const override { return identity_; }
    [[nodiscard]] const Capabilities& capabilities() const override { return capabilities_; }
    [[nodiscard]] CalibrationStep calibrate(base::TimePoint now) override;
    [[nodiscard]] Sample read(base::TimePoint now) override;
    void apply(const GovernedForce& force) override;
    void halt() noexcept override;
    void pace(const std::function<bool()>& beat) override;

    /// Returns the number of lost messages, by the device's own count.
    [[nodiscard]] std::uint64_t lost() const { return lost_; }
    /// Returns the number of invalid messages.
    [[nodiscard]] std::uint64_t garbled() const { return garbled_; }

private:
    struct Started {
        std::unique_ptr<Link> link;
        std::string serial;
    };
    Omni(Started started, const Profile& profile, Use use);

    /// Takes the packets that have arrived. Returns true if a beat is due.
    [[nodiscard]] bool gather();
    void take(const ReceivedPacket& received, base::TimePoint now);
    [[nodiscard]] HostPacket lights() const;

    struct News {
        Arrival arrival = Arrival::nothing;
        ReceivedPacket packet;
    };

    std::unique_ptr<Link> link_;
    Identity identity_;
    Capabilities capabilities_;
    Drive drive_;
    omni::Tracker tracker_;
    Sample sample_;
    bool has_gone_ = false;
    std::optional<std::uint32_t> message_; // number of the last message
    std::uint64_t lost_ = 0;
    std::uint64_t garbled_ = 0;
    std::array<News, 64> news_; // arrivals that read() has not used yet
    std::size_t news_count_ = 0;
    std::optional<unsigned> beat_cycle_; // cycle of the bus at the last beat
};

} // namespace hapnet::device::omni1394

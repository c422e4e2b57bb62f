// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/omni1394/link.hpp"
#include "tests/support/omni1394/fake_omni.hpp"

#include <algorithm>
#include <deque>

namespace hapnet::device::omni1394 {

/// A bus in memory with one device on it.
struct MemoryBus {
    FakeOmni omni;
    std::deque<ReceivedPacket> packets{};
    unsigned cycle = 0;
    int resets = 0; // bus resets not reported yet
    bool gone = false;
    bool refuses = false; // every register
    bool is_open = false;

    /// Lives through a millisecond, and a packet comes.
    void pass_one_millisecond()
    {
        cycle = (cycle + 8) % 8000;
        say(omni.live(std::chrono::milliseconds{1}));
    }
    void say(std::span<const std::byte> bytes)
    {
        if (bytes.empty() || gone) return;
        ReceivedPacket& packet = packets.emplace_back();
        packet.size = std::min(bytes.size(), packet.bytes.size());
        std::copy_n(bytes.begin(), packet.size, packet.bytes.begin());
        packet.cycle = cycle;
        if (packets.size() > 64) packets.pop_front();
    }
};

class MemoryLink final : public Link {
public:
    explicit MemoryLink(MemoryBus& bus) : bus_{bus} { bus_.is_open = true; }
    ~MemoryLink() override { bus_.is_open = false; }

    [[nodiscard]] Opened<Channels> allocate() override { return Channels{3, 5}; }
    [[nodiscard]] Opened<std::size_t> read_register(std::uint64_t address,
                                                    std::span<std::byte> bytes) override
    {
        const auto value = bus_.omni.read_register(address, bytes.size());
        if (!value || bus_.refuses) return device_error(Fault::communication, "no such register");
        std::copy(value->begin(), value->end(), bytes.begin());
        return value->size();
    }
    [[nodiscard]] Opened<std::size_t> write_register(std::uint64_t address,
                                                     std::span<const std::byte> bytes) override
    {
        if (!bus_.omni.write_register(address, bytes)) {
            return device_error(Fault::communication, "no such register");
        }
        return bytes.size();
    }
    [[nodiscard]] Opened<Channels> start(const Channels& channels) override { return channels; }
    void drain() noexcept override {}
    [[nodiscard]] Arrival receive(ReceivedPacket& packet) noexcept override
    {
        if (bus_.gone) return Arrival::gone;
        if (bus_.resets > 0) {
            --bus_.resets;
            return Arrival::bus_reset;
        }
        if (bus_.packets.empty()) return Arrival::nothing;
        packet = bus_.packets.front();
        bus_.packets.pop_front();
        return Arrival::packet;
    }
    bool send(const HostPacket& packet) noexcept override
    {
        if (!bus_.gone) bus_.omni.hear(encode(packet));
        return !bus_.gone;
    }
    [[nodiscard]] bool wait(base::Duration /*most*/) noexcept override
    {
        return bus_.gone || bus_.resets > 0 || !bus_.packets.empty();
    }

private:
    MemoryBus& bus_;
};

} // namespace hapnet::device::omni1394

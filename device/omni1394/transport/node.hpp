// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/fault.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace hapnet::device::omni1394 {

/// An event of a node, as in <linux/firewire-cdev.h>, byte for byte. It has room for a page of
/// isochronous headers.
struct alignas(8) Event {
    std::array<std::byte, 4096 + 64> bytes{};
    std::size_t size = 0;

    /// Returns FW_CDEV_EVENT_..., or UINT32_MAX if the bytes are too short for an event.
    [[nodiscard]] std::uint32_t type() const;
    [[nodiscard]] std::span<const std::byte> content() const
    {
        return std::span{bytes}.first(size);
    }
};

/// The result of reading an event.
enum class ReadOutcome : std::uint8_t { nothing, event, gone };

/// An open /dev/fwN: a thin wrapper that takes no decisions. The kernel has one isochronous context
/// for each open node.
class Node {
public:
    [[nodiscard]] static Opened<Node> open(const std::string& path);
    ~Node();
    Node(const Node&) = delete;
    Node& operator=(const Node&) = delete;
    Node(Node&& other) noexcept;
    Node& operator=(Node&& other) noexcept;

    /// Locks the node against other programs that also lock it, until it is closed. Returns false
    /// if another program has locked it.
    [[nodiscard]] bool lock();
    /// Makes an ioctl. Returns 0, or the kernel's error number.
    [[nodiscard]] int control(unsigned long request, void* argument) const noexcept;
    /// Reads the next event, if one arrives within the time.
    [[nodiscard]] ReadOutcome read(Event& event, base::Duration within) const noexcept;

    [[nodiscard]] int descriptor() const { return descriptor_; }
    [[nodiscard]] std::uint32_t generation() const { return generation_; } // generation of the bus

    void set_generation(std::uint32_t generation) { generation_ = generation; }

private:
    Node(int descriptor, std::uint32_t generation)
        : descriptor_{descriptor}, generation_{generation}
    {}

    int descriptor_ = -1;
    std::uint32_t generation_ = 0;
};

/// Returns the error of a failed call to the kernel, with the remedy.
[[nodiscard]] DeviceError error_of(int error, const std::string& what);

} // namespace hapnet::device::omni1394

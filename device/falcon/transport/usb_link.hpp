// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/falcon/link.hpp"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <libusb.h>
#include <memory>

namespace hapnet::device::falcon {

inline constexpr unsigned char endpoint_in = 0x81;
inline constexpr unsigned char endpoint_out = 0x02;
inline constexpr std::size_t usb_packet_bytes = 64;
inline constexpr std::size_t ftdi_status_bytes = 2; // before each packet from FTDI's chip

/// An open device whose interface 0 is claimed, or is about to be. It has a library context of its
/// own, so that no other code handles its events.
struct ClaimedUsb {
    struct Exit {
        void operator()(libusb_context* ours) const { libusb_exit(ours); }
    };
    struct Release {
        void operator()(libusb_device_handle* open) const
        {
            libusb_release_interface(open, 0);
            libusb_close(open);
        }
    };
    std::unique_ptr<libusb_context, Exit> context;
    std::unique_ptr<libusb_device_handle, Release> handle;
};

/// Sends packets over libusb. At most one transfer is in progress in each direction, and one more
/// for interrupt(). There is no separate thread: the library's events are handled inside the calls,
/// and those of interrupt() may be on another thread. Therefore the end of a transfer only stores
/// its outcome.
class UsbLink final : public Link {
public:
    explicit UsbLink(ClaimedUsb usb);
    ~UsbLink() override;
    UsbLink(const UsbLink&) = delete;
    UsbLink& operator=(const UsbLink&) = delete;

    [[nodiscard]] bool send(const Packet& packet) noexcept override;
    [[nodiscard]] std::span<const std::byte> receive(Wait wait) noexcept override;
    [[nodiscard]] bool is_gone() const noexcept override { return is_gone_; }
    void interrupt(const Packet& packet) noexcept override;
    void send_now(const Packet& packet) noexcept override;

private:
    struct Free {
        void operator()(libusb_transfer* transfer) const { libusb_free_transfer(transfer); }
    };
    using Transfer = std::unique_ptr<libusb_transfer, Free>;
    using Buffer = std::array<unsigned char, usb_packet_bytes>;

    /// State of the incoming transfer.
    enum class Listening : std::uint8_t { idle, pending, completed };

    static void on_in(libusb_transfer* transfer);
    static void on_out(libusb_transfer* transfer);
    static void on_urgent(libusb_transfer* transfer);

    [[nodiscard]] bool submit(libusb_transfer* transfer) noexcept;
    void listen() noexcept;
    void collect() noexcept;
    void handle_events(int milliseconds_max) noexcept;
    [[nodiscard]] bool is_idle() const noexcept;

    ClaimedUsb usb_;
    Transfer in_;
    Transfer out_;
    Transfer urgent_;
    Buffer in_buffer_{};
    Buffer out_buffer_{};
    Buffer urgent_buffer_{};
    std::array<std::byte, 4 * usb_packet_bytes> inbox_{}; // receive() collects at most 4 times
    std::size_t inbox_size_ = 0;
    std::atomic<Listening> listening_{Listening::idle};
    std::atomic<bool> sends_{false};
    bool closes_ = false;
    std::atomic<bool> is_gone_{false};
    std::atomic<bool> interrupts_{false};
};

} // namespace hapnet::device::falcon

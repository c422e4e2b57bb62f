// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/falcon/transport/usb_link.hpp"

#include <algorithm>
#include <cstring>
#include <new>
#include <tuple>
#include <utility>

namespace hapnet::device::falcon {

namespace {

// The library waits in whole milliseconds.
constexpr int brief_wait_ms = 1;
constexpr int send_now_rounds = 50;
constexpr int close_rounds = 100;

void put(const Packet& packet, std::array<unsigned char, usb_packet_bytes>& buffer)
{
    std::memcpy(buffer.data(), packet.data(), packet.size());
}

} // namespace

UsbLink::UsbLink(ClaimedUsb usb)
    : usb_{std::move(usb)},
      in_{libusb_alloc_transfer(0)},
      out_{libusb_alloc_transfer(0)},
      urgent_{libusb_alloc_transfer(0)}
{
    if (!in_ || !out_ || !urgent_) throw std::bad_alloc{};
    constexpr int packet_size = static_cast<int>(packet_bytes);
    libusb_fill_bulk_transfer(in_.get(), usb_.handle.get(), endpoint_in, in_buffer_.data(),
                              static_cast<int>(in_buffer_.size()), on_in, this, 0);
    libusb_fill_bulk_transfer(out_.get(), usb_.handle.get(), endpoint_out, out_buffer_.data(),
                              packet_size, on_out, this, 0);
    libusb_fill_bulk_transfer(urgent_.get(), usb_.handle.get(), endpoint_out, urgent_buffer_.data(),
                              packet_size, on_urgent, this, 0);
    listen();
}

UsbLink::~UsbLink()
{
    closes_ = true;
    if (listening_ == Listening::pending) libusb_cancel_transfer(in_.get());
    if (sends_) libusb_cancel_transfer(out_.get());
    if (interrupts_) libusb_cancel_transfer(urgent_.get());
    for (int i = 0; i < close_rounds && !is_idle(); ++i) handle_events(brief_wait_ms);
    if (is_idle()) return;
    // The library still uses the transfers. Leaking them is better than a write to freed memory.
    std::ignore = in_.release();
    std::ignore = out_.release();
    std::ignore = urgent_.release();
}

bool UsbLink::is_idle() const noexcept
{
    return listening_ != Listening::pending && !sends_ && !interrupts_;
}

bool UsbLink::submit(libusb_transfer* transfer) noexcept
{
    if (is_gone_) return false;
    const int result = libusb_submit_transfer(transfer);
    if (result == LIBUSB_ERROR_NO_DEVICE) is_gone_ = true;
    return result == LIBUSB_SUCCESS;
}

void UsbLink::listen() noexcept
{
    if (listening_ != Listening::idle || closes_) return;
    listening_ = Listening::pending; // set first: the transfer may end before submit() returns
    if (!submit(in_.get())) listening_ = Listening::idle;
}

bool UsbLink::send(const Packet& packet) noexcept
{
    if (sends_) return false;
    put(packet, out_buffer_);
    sends_ = true; // set first: the transfer may end before submit() returns
    if (submit(out_.get())) return true;
    sends_ = false;
    return false;
}

void UsbLink::send_now(const Packet& packet) noexcept
{
    for (int i = 0; i < send_now_rounds && sends_; ++i) handle_events(brief_wait_ms);
    if (!send(packet)) return;
    for (int i = 0; i < send_now_rounds && sends_; ++i) handle_events(brief_wait_ms);
}

void UsbLink::interrupt(const Packet& packet) noexcept
{
    // The previous transfer may have ended long ago, but its events were not handled yet.
    if (interrupts_) handle_events(0);
    if (interrupts_.exchange(true)) return;
    put(packet, urgent_buffer_);
    if (!submit(urgent_.get())) interrupts_ = false;
}

std::span<const std::byte> UsbLink::receive(Wait wait) noexcept
{
    inbox_size_ = 0;
    collect();
    handle_events(0);
    collect();
    // The first wait may end because our own packet has left. Then it waits once more.
    for (int round = 0; round < 2 && wait == Wait::briefly && inbox_size_ == 0; ++round) {
        const bool was_sending = sends_;
        handle_events(brief_wait_ms);
        collect();
        if (!was_sending || sends_) break;
    }
    return std::span{inbox_}.first(inbox_size_);
}

void UsbLink::handle_events(int milliseconds_max) noexcept
{
    timeval most{0, 1000L * milliseconds_max};
    libusb_handle_events_timeout_completed(usb_.context.get(), &most, nullptr);
}

/// Takes the bytes that have arrived, and starts the next transfer.
void UsbLink::collect() noexcept
{
    if (listening_ == Listening::completed) {
        const auto size = static_cast<std::size_t>(in_->actual_length);
        const auto bytes = std::as_bytes(std::span{in_buffer_}).first(size);
        const auto theirs = bytes.subspan(std::min(ftdi_status_bytes, size));
        std::copy(theirs.begin(), theirs.end(), std::span{inbox_}.subspan(inbox_size_).begin());
        inbox_size_ += theirs.size();
        listening_ = Listening::idle;
    }
    listen();
}

void UsbLink::on_in(libusb_transfer* transfer)
{
    auto& link = *static_cast<UsbLink*>(transfer->user_data);
    if (transfer->status == LIBUSB_TRANSFER_NO_DEVICE) link.is_gone_ = true;
    link.listening_ =
        transfer->status == LIBUSB_TRANSFER_COMPLETED ? Listening::completed : Listening::idle;
}

void UsbLink::on_out(libusb_transfer* transfer)
{
    auto& link = *static_cast<UsbLink*>(transfer->user_data);
    if (transfer->status == LIBUSB_TRANSFER_NO_DEVICE) link.is_gone_ = true;
    link.sends_ = false;
}

void UsbLink::on_urgent(libusb_transfer* transfer)
{
    auto& link = *static_cast<UsbLink*>(transfer->user_data);
    if (transfer->status == LIBUSB_TRANSFER_NO_DEVICE) link.is_gone_ = true;
    link.interrupts_ = false;
}

} // namespace hapnet::device::falcon

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/umockdev/usb_device.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <iterator>
#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <utility>

namespace hapnet::umockdev {

namespace {

constexpr std::size_t setup_bytes = 8;
constexpr std::uint8_t to_host = 0x80;
constexpr std::uint8_t get_descriptor = 6;
constexpr std::uint16_t string_descriptors = 3;

UsbSetup setup_of(std::span<const std::byte> bytes)
{
    const auto at = [&](std::size_t i) { return std::to_integer<std::uint16_t>(bytes[i]); };
    const auto word = [&](std::size_t i) {
        return static_cast<std::uint16_t>(at(i) | static_cast<std::uint16_t>(at(i + 1) << 8U));
    };
    return {static_cast<std::uint8_t>(at(0)), static_cast<std::uint8_t>(at(1)), word(2), word(4),
            word(6)};
}

} // namespace

UsbDevice::UsbDevice(Testbed& testbed, UsbDescription description, UsbModel& model)
    : testbed_{testbed},
      usb_{std::move(description)},
      model_{model},
      kernel_has_it_{!usb_.kernel_driver.empty()}
{
    attachment_.emplace(testbed_, node_of(usb_), static_cast<Handler&>(*this));
    testbed_.add(testbed_text_of(usb_));
}

UsbDevice::~UsbDevice() = default;

void UsbDevice::stall(bool on)
{
    const std::lock_guard lock{mutex_};
    stalled_ = on;
    work();
}

void UsbDevice::unplug()
{
    {
        const std::lock_guard lock{mutex_};
        for (auto& [opener, has_gone] : openers_) has_gone = true;
        for (Transfer& transfer : under_way_) finish(transfer, -ESHUTDOWN, 0);
        under_way_.clear();
        owner_ = nullptr;
        model_.on_released();
    }
    testbed_.remove(path_of(usb_));
}

void UsbDevice::plug_in()
{
    {
        const std::lock_guard lock{mutex_};
        kernel_has_it_ = !usb_.kernel_driver.empty();
        stalled_ = false;
    }
    testbed_.add(testbed_text_of(usb_));
}

bool UsbDevice::kernel_has_it()
{
    const std::lock_guard lock{mutex_};
    return kernel_has_it_;
}

bool UsbDevice::on_ioctl(const Request& request)
{
    const std::lock_guard lock{mutex_};
    const bool has_gone = openers_.try_emplace(request.opener(), false).first->second;
    const bool reaps =
        request.code() == USBDEVFS_REAPURB || request.code() == USBDEVFS_REAPURBNDELAY;
    if (has_gone && !reaps) {
        request.fail(ENODEV);
        return true;
    }
    return answer(request);
}

void UsbDevice::on_closed(const void* opener)
{
    const std::lock_guard lock{mutex_};
    const auto is_theirs = [&](const Transfer& transfer) { return transfer.opener == opener; };
    std::erase_if(under_way_, is_theirs);
    std::erase_if(done_, is_theirs);
    openers_.erase(opener);
    release(opener);
}

bool UsbDevice::answer(const Request& request)
{
    switch (request.code()) {
    case USBDEVFS_GET_CAPABILITIES:
        request.argument(sizeof(std::uint32_t))
            .write_as(std::uint32_t{USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_NO_PACKET_SIZE_LIM |
                                    USBDEVFS_CAP_REAP_AFTER_DISCONNECT});
        request.succeed();
        return true;
    case USBDEVFS_CLAIMINTERFACE: claim(request, false); return true;
    case USBDEVFS_DISCONNECT_CLAIM: claim(request, true); return true;
    case USBDEVFS_RELEASEINTERFACE:
        release(request.opener());
        request.succeed();
        return true;
    case USBDEVFS_GETDRIVER: {
        if (!kernel_has_it_) {
            request.fail(ENODATA);
            return true;
        }
        usbdevfs_getdriver driver{};
        usb_.kernel_driver.copy(driver.driver, sizeof driver.driver - 1);
        request.argument(sizeof driver).write_as(driver);
        request.succeed();
        return true;
    }
    case USBDEVFS_IOCTL: reconnect_kernel(request); return true;
    case USBDEVFS_SETINTERFACE:
    case USBDEVFS_CLEAR_HALT:
    case USBDEVFS_RESET: request.succeed(); return true;
    case USBDEVFS_SUBMITURB: submit(request); return true;
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY: reap(request); return true;
    case USBDEVFS_DISCARDURB: discard(request); return true;
    default: request.fail(ENOTTY); return true;
    }
}

void UsbDevice::claim(const Request& request, bool from_kernel)
{
    const bool is_taken = owner_ != nullptr && owner_ != request.opener();
    if (is_taken || (kernel_has_it_ && !from_kernel)) {
        request.fail(EBUSY);
        return;
    }
    kernel_has_it_ = false;
    owner_ = request.opener();
    request.succeed();
}

void UsbDevice::release(const void* opener)
{
    if (owner_ != opener) return;
    owner_ = nullptr;
    model_.on_released();
}

void UsbDevice::reconnect_kernel(const Request& request)
{
    const auto wanted = request.argument(sizeof(usbdevfs_ioctl)).as<usbdevfs_ioctl>();
    const bool connects = static_cast<unsigned>(wanted.ioctl_code) == USBDEVFS_CONNECT;
    if (usb_.kernel_driver.empty() || kernel_has_it_ == connects) {
        request.fail(ENODATA);
        return;
    }
    kernel_has_it_ = connects;
    request.succeed(1);
}

void UsbDevice::submit(const Request& request)
{
    Transfer transfer{request.opener(), request.argument(sizeof(usbdevfs_urb)), {}};
    const auto urb = transfer.urb.as<usbdevfs_urb>();
    const bool is_control = urb.type == USBDEVFS_URB_TYPE_CONTROL;
    if (!is_control && urb.endpoint != usb_.endpoint_in && urb.endpoint != usb_.endpoint_out) {
        request.fail(ENOENT);
        return;
    }
    if (!is_control && owner_ != request.opener()) {
        request.fail(EBUSY);
        return;
    }
    if (urb.buffer_length > 0) {
        transfer.buffer = transfer.urb.pointed_to(offsetof(usbdevfs_urb, buffer),
                                                  static_cast<std::size_t>(urb.buffer_length));
    }
    if (!transfer.urb || (urb.buffer_length > 0 && !transfer.buffer)) {
        request.fail(EFAULT); // the program has ended
        return;
    }
    under_way_.push_back(std::move(transfer));
    work();
    request.succeed();
}

void UsbDevice::reap(const Request& request)
{
    work();
    const auto transfer = std::find_if(done_.begin(), done_.end(), [&](const Transfer& one) {
        return one.opener == request.opener();
    });
    if (transfer == done_.end()) {
        request.fail(openers_[request.opener()] ? ENODEV : EAGAIN);
        return;
    }
    request.argument(sizeof(void*)).point_to(0, transfer->urb);
    done_.erase(transfer);
    request.succeed();
}

void UsbDevice::discard(const Request& request)
{
    const auto transfer =
        std::find_if(under_way_.begin(), under_way_.end(), [&](const Transfer& one) {
            return one.opener == request.opener() && one.urb.address() == request.number();
        });
    if (transfer == under_way_.end()) {
        request.fail(EINVAL);
        return;
    }
    finish(*transfer, -ENOENT, 0);
    under_way_.erase(transfer);
    request.succeed();
}

/// Continues until nothing more can be done, because an answer may be possible at once.
void UsbDevice::work()
{
    if (stalled_) return;
    for (bool moved = true; moved;) {
        moved = false;
        for (auto transfer = under_way_.begin(); transfer != under_way_.end();) {
            const bool is_done = carry_out(*transfer) == Step::done;
            transfer = is_done ? under_way_.erase(transfer) : std::next(transfer);
            moved = moved || is_done;
        }
    }
}

UsbDevice::Step UsbDevice::carry_out(Transfer& transfer)
{
    const auto urb = transfer.urb.as<usbdevfs_urb>();
    if (urb.type == USBDEVFS_URB_TYPE_CONTROL) {
        control(transfer);
        return Step::done;
    }
    const std::size_t size = transfer.buffer ? transfer.buffer.bytes().size() : 0;
    if (urb.endpoint == usb_.endpoint_out) {
        if (size > 0) model_.on_bulk_out(transfer.buffer.bytes());
        finish(transfer, 0, size);
        return Step::done;
    }
    const auto said = model_.on_bulk_in(size);
    if (!said) return Step::waits;
    transfer.buffer.write(0, *said);
    finish(transfer, 0, said->size());
    return Step::done;
}

void UsbDevice::control(Transfer& transfer)
{
    const auto bytes = transfer.buffer.bytes();
    if (bytes.size() < setup_bytes) {
        finish(transfer, -EINVAL, 0);
        return;
    }
    const UsbSetup setup = setup_of(bytes);
    const auto said = reply(setup, bytes.subspan(setup_bytes));
    if (!said) {
        finish(transfer, -EPIPE, 0);
        return;
    }
    const std::size_t count = std::min<std::size_t>(said->size(), setup.length);
    transfer.buffer.write(setup_bytes, std::span{*said}.first(count));
    finish(transfer, 0, (setup.type & to_host) != 0 ? count : setup.length);
}

std::optional<std::vector<std::byte>> UsbDevice::reply(const UsbSetup& setup,
                                                       std::span<const std::byte> data)
{
    const bool asks_for_string = setup.type == to_host && setup.request == get_descriptor &&
                                 setup.value >> 8U == string_descriptors;
    if (!asks_for_string) return model_.on_control(setup, data);
    auto text = string_descriptor_of(usb_, static_cast<std::uint8_t>(setup.value & 0xffU));
    if (text.empty()) return std::nullopt;
    return text;
}

/// `count` without a control transfer's setup bytes.
void UsbDevice::finish(Transfer& transfer, int status, std::size_t count)
{
    transfer.urb.write_as(status, offsetof(usbdevfs_urb, status));
    transfer.urb.write_as(static_cast<int>(count), offsetof(usbdevfs_urb, actual_length));
    done_.push_back(transfer);
}

} // namespace hapnet::umockdev

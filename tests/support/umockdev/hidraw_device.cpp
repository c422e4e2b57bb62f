// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The node is a terminal, so that a reader can see that data waits. But a terminal has no reports,
// so one byte through it is only a bell, and the reader gets the reports on read().
#include "tests/support/umockdev/hidraw_device.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <linux/hidraw.h>
#include <spdlog/fmt/fmt.h>
#include <stdexcept>
#include <sys/ioctl.h>
#include <termios.h>
#include <tuple>
#include <unistd.h>
#include <utility>

namespace hapnet::umockdev {

namespace {

constexpr std::size_t reports_max = 64;
constexpr int numbers_per_plug = 16; // more than the number of devices at once

std::string hex_text(std::span<const std::byte> bytes)
{
    std::string text;
    for (const std::byte byte : bytes) text += fmt::format("{:02X}", std::to_integer<int>(byte));
    return text;
}

/// The places in sysfs of the device, its interface, the HID device and its node: parents first.
std::array<std::string, 4> paths_of(const HidDescription& hid)
{
    const std::string usb = fmt::format("/devices/usb9/9-{}", hid.number + 1);
    const std::string interface = fmt::format("{}/9-{}:1.0", usb, hid.number + 1);
    const std::string device = fmt::format("{}/0003:{:04X}:{:04X}.{:04X}", interface, hid.vendor,
                                           hid.product, hid.number + 1);
    return {usb, interface, device, fmt::format("{}/hidraw/hidraw{}", device, hid.number)};
}

std::string testbed_text(const HidDescription& hid)
{
    const auto& [usb_path, interface_path, hid_path, node_path] = paths_of(hid);
    return fmt::format("P: {0}\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\n"
                       "A: idVendor={1:04x}\\n\nA: idProduct={2:04x}\\n\n"
                       "A: product={3}\\n\nA: serial={4}\\n\n\n",
                       usb_path, hid.vendor, hid.product, hid.name, hid.serial) +
           fmt::format("P: {0}\nE: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\n"
                       "A: bInterfaceNumber=00\\n\n\n",
                       interface_path) +
           fmt::format("P: {0}\nE: SUBSYSTEM=hid\nE: DRIVER=hid-generic\n"
                       "E: HID_ID=0003:{1:08X}:{2:08X}\nE: HID_NAME={3}\nE: HID_UNIQ={4}\n"
                       "H: report_descriptor={5}\n\n",
                       hid_path, hid.vendor, hid.product, hid.name, hid.serial,
                       hex_text(hid.report_descriptor)) +
           fmt::format("P: {0}\nN: hidraw{1}\nE: DEVNAME=/dev/hidraw{1}\n"
                       "E: SUBSYSTEM=hidraw\nL: device=../../../{2}\n",
                       node_path, hid.number, hid_path.substr(hid_path.rfind('/') + 1));
}

} // namespace

HidrawDevice::HidrawDevice(Testbed& testbed, HidDescription description, HidModel& model)
    : testbed_{testbed}, hid_{std::move(description)}, model_{model}
{
    testbed_.add(testbed_text(hid_));
    attach();
}

HidrawDevice::~HidrawDevice()
{
    if (slave_ >= 0) close(slave_);
}

std::string HidrawDevice::node() const { return fmt::format("/dev/hidraw{}", hid_.number); }

void HidrawDevice::attach()
{
    attachment_.emplace(testbed_, node(), static_cast<Handler&>(*this));
    const std::lock_guard lock{mutex_};
    master_ = testbed_.master_of(node());
    slave_ = open(testbed_.real_path(node()).c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
    if (master_ < 0 || slave_ < 0) throw std::runtime_error{node() + " is no terminal"};
}

void HidrawDevice::say(std::vector<std::byte> report)
{
    const std::lock_guard lock{mutex_};
    if (stalled_ || has_gone_ || waiting_.size() >= reports_max) return;
    waiting_.push_back(std::move(report));
    if (waiting_.size() == 1) std::ignore = ::write(master_, "!", 1);
}

void HidrawDevice::silence() { tcflush(slave_, TCIFLUSH); }

void HidrawDevice::stall(bool on)
{
    const std::lock_guard lock{mutex_};
    stalled_ = on;
    if (stalled_) return;
    for (const Held& held : std::exchange(held_up_, {})) carry_out(held);
}

void HidrawDevice::unplug()
{
    {
        const std::lock_guard lock{mutex_};
        has_gone_ = true;
        for (const Held& held : std::exchange(held_up_, {})) held.request.fail(ENODEV);
        waiting_.clear();
        close(std::exchange(slave_, -1));
        // Ends the terminal, and leaves the number to programs that think it is open.
        const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
        dup2(nothing, master_);
        close(nothing);
    }
    const auto paths = paths_of(hid_);
    std::for_each(paths.rbegin(), paths.rend(),
                  [&](const std::string& path) { testbed_.remove("/sys" + path); });
}

void HidrawDevice::plug_in()
{
    attachment_.reset();
    {
        const std::lock_guard lock{mutex_};
        has_gone_ = false;
        stalled_ = false;
        hid_.number += numbers_per_plug;
    }
    testbed_.add(testbed_text(hid_));
    attach();
}

bool HidrawDevice::on_read(const Request& request)
{
    const std::lock_guard lock{mutex_};
    if (has_gone_) {
        request.fail(EIO);
        return true;
    }
    if (waiting_.empty()) {
        silence();
        request.fail(EAGAIN);
        return true;
    }
    Memory buffer = request.buffer();
    const std::vector<std::byte> report = std::exchange(waiting_.front(), {});
    waiting_.pop_front();
    if (waiting_.empty()) silence();
    const std::size_t size = std::min(report.size(), buffer.bytes().size());
    buffer.write(0, std::span{report}.first(size));
    request.succeed(static_cast<long>(size));
    return true;
}

bool HidrawDevice::on_write(const Request& request)
{
    const std::lock_guard lock{mutex_};
    carry_out({request, true});
    return true;
}

bool HidrawDevice::on_ioctl(const Request& request)
{
    const std::lock_guard lock{mutex_};
    const auto size = static_cast<std::uint32_t>(hid_.report_descriptor.size());
    if (request.code() == HIDIOCGRDESCSIZE) {
        request.argument(sizeof(int)).write_as(static_cast<int>(size));
        request.succeed();
        return true;
    }
    if (request.code() == HIDIOCGRDESC) {
        Memory memory = request.argument(sizeof(hidraw_report_descriptor));
        memory.write(offsetof(hidraw_report_descriptor, value), hid_.report_descriptor);
        memory.write_as(size, offsetof(hidraw_report_descriptor, size));
        request.succeed();
        return true;
    }
    if (_IOC_TYPE(request.code()) != 'H') return false;
    carry_out({request, false});
    return true;
}

void HidrawDevice::carry_out(const Held& held)
{
    constexpr unsigned set = 0x06; // of HIDIOCSFEATURE and HIDIOCGFEATURE
    constexpr unsigned get = 0x07;
    const Request& request = held.request;
    if (has_gone_) return request.fail(ENODEV);
    if (stalled_) return held_up_.push_back(held);
    if (held.is_write) {
        const Memory report = request.buffer();
        model_.on_output(report.bytes());
        return request.succeed(static_cast<long>(report.bytes().size()));
    }
    if (_IOC_NR(request.code()) == set) return set_feature(request);
    if (_IOC_NR(request.code()) == get) return get_feature(request);
    request.fail(EINVAL);
}

void HidrawDevice::set_feature(const Request& request)
{
    const std::size_t size = _IOC_SIZE(request.code());
    model_.on_feature(request.argument(size).bytes());
    request.succeed(static_cast<long>(size));
}

void HidrawDevice::get_feature(const Request& request)
{
    Memory memory = request.argument(_IOC_SIZE(request.code()));
    const auto answer = model_.feature(memory.as<std::uint8_t>());
    if (!answer) return request.fail(EPIPE);
    const std::size_t size = std::min(answer->size(), memory.bytes().size());
    memory.write(0, std::span{*answer}.first(size));
    request.succeed(static_cast<long>(size));
}

} // namespace hapnet::umockdev

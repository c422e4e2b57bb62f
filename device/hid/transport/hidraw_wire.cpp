// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/transport/hidraw_wire.hpp"

#include <cerrno>
#include <hidapi.h>
#include <utility>

namespace hapnet::device::hid {

namespace {

/// Returns the result of a call that returns -1 when it fails. errno was 0 before the call.
TransferResult moved_by(int result)
{
    if (result >= 0) return TransferResult::yes;
    return errno == ENODEV || errno == ENXIO ? TransferResult::gone : TransferResult::failed;
}

const unsigned char* raw(std::span<const std::byte> bytes)
{
    return reinterpret_cast<const unsigned char*>(bytes.data());
}

unsigned char* raw(std::span<std::byte> bytes)
{
    return reinterpret_cast<unsigned char*>(bytes.data());
}

} // namespace

void HidrawWire::Close::operator()(hid_device_* device) const { hid_close(device); }

Opened<std::unique_ptr<Wire>> HidrawWire::open(const std::string& path, std::optional<Claim> claim)
{
    Handle handle{hid_open_path(path.c_str())};
    if (!handle || hid_set_nonblocking(handle.get(), 1) != 0) {
        return device_error(Fault::communication,
                            path + " does not open: unplug the device and plug it in again", errno);
    }
    return std::unique_ptr<Wire>{new HidrawWire{std::move(handle), std::move(claim)}};
}

ReadResult HidrawWire::read(std::span<std::byte> into)
{
    const int size = hid_read(handle_.get(), raw(into), into.size());
    if (size < 0) return {TransferResult::gone, 0};
    if (size == 0) return {TransferResult::nothing, 0};
    return {TransferResult::yes, static_cast<std::size_t>(size)};
}

TransferResult HidrawWire::write(std::span<const std::byte> report)
{
    errno = 0;
    return moved_by(hid_write(handle_.get(), raw(report), report.size()));
}

TransferResult HidrawWire::set_feature(std::span<const std::byte> report)
{
    errno = 0;
    return moved_by(hid_send_feature_report(handle_.get(), raw(report), report.size()));
}

TransferResult HidrawWire::get_feature(std::span<std::byte> report)
{
    errno = 0;
    return moved_by(hid_get_feature_report(handle_.get(), raw(report), report.size()));
}

} // namespace hapnet::device::hid

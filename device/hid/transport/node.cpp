// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/transport/node.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sys/file.h>
#include <unistd.h>

namespace hapnet::device::hid {

namespace {

tl::unexpected<DeviceError> why_not(const std::string& path, int error)
{
    if (error == EACCES || error == EPERM) {
        return device_error(
            Fault::permission,
            "no permission to use " + path +
                ": install the udev rules (hapnet-peer doctor says how), then unplug "
                "the device and plug it in again",
            error);
    }
    if (error == EWOULDBLOCK || error == EBUSY) {
        return device_error(Fault::in_use,
                            path + " is in use by another program: end that one first", error);
    }
    return device_error(Fault::disconnected, path + " has gone: plug the device in and start again",
                        error);
}

} // namespace

Opened<Claim> Claim::take(const std::string& path)
{
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (descriptor < 0) return why_not(path, errno);
    Claim claim{descriptor};
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) return why_not(path, errno);
    return claim;
}

Claim::~Claim()
{
    if (descriptor_ >= 0) close(descriptor_);
}

std::optional<std::vector<std::byte>> descriptor_of(const std::string& path)
{
    const std::string name = std::filesystem::path{path}.filename().string();
    std::ifstream file{"/sys/class/hidraw/" + name + "/device/report_descriptor", std::ios::binary};
    if (!file) return std::nullopt;
    std::vector<std::byte> bytes;
    std::transform(std::istreambuf_iterator<char>{file}, {}, std::back_inserter(bytes),
                   [](char c) { return static_cast<std::byte>(c); });
    return bytes;
}

} // namespace hapnet::device::hid

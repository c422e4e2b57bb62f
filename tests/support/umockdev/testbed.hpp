// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

// NOLINTNEXTLINE(bugprone-reserved-identifier): its library's name for it
typedef struct _UMockdevTestbed UMockdevTestbed;

namespace hapnet::umockdev {

/// An empty /sys and /dev for this process and the children that it starts from now on. Only one at
/// a time. Make it before anything looks for devices.
class Testbed {
public:
    /// Throws where the program does not run under umockdev, which main.cpp here sees to.
    Testbed();

    /// Adds devices, in the format of `umockdev-record`: P:, N:, E:, A:, H: lines, parents first.
    /// Throws when it is not understood.
    void add(const std::string& description);
    /// Takes a device away: "/sys/devices/...". Its node goes with it.
    void remove(const std::string& path);
    /// Tells programs that listen to the kernel: "add", "remove", "change".
    void announce(const std::string& path, const std::string& action);

    /// Returns the real place of a path such as "/dev/bus/usb/001/002".
    [[nodiscard]] std::string real_path(const std::string& path) const;
    /// The other end of a node that is a terminal; -1 when there is none.
    [[nodiscard]] int master_of(const std::string& node) const;

    [[nodiscard]] UMockdevTestbed* raw() const { return testbed_.get(); }

private:
    std::shared_ptr<UMockdevTestbed> testbed_;
};

} // namespace hapnet::umockdev

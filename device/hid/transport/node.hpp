// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/fault.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::device::hid {

/// A claim to a hidraw node. The kernel lets several programs open a node, so the programs of this
/// project use a lock on it.
class Claim {
public:
    /// Returns the claim, or the reason why there is none: no permission, in use, gone.
    [[nodiscard]] static Opened<Claim> take(const std::string& path);

    ~Claim();
    Claim(Claim&& other) noexcept : descriptor_{std::exchange(other.descriptor_, -1)} {}
    Claim& operator=(Claim&& other) noexcept
    {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;

private:
    explicit Claim(int descriptor) : descriptor_{descriptor} {}

    int descriptor_;
};

/// Returns the report descriptor of `path`, such as "/dev/hidraw0", which anyone may read; nullopt
/// if it does not exist.
[[nodiscard]] std::optional<std::vector<std::byte>> descriptor_of(const std::string& path);

} // namespace hapnet::device::hid

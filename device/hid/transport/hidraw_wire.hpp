// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/fault.hpp"
#include "device/hid/transport/node.hpp"
#include "device/hid/wire.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>

// NOLINTNEXTLINE(bugprone-reserved-identifier): hidapi's name for it
struct hid_device_;

namespace hapnet::device::hid {

/// Exchanges reports through hidapi and the kernel's hidraw. hidapi keeps an error text in each
/// opened device without a lock, so each thread opens its own.
class HidrawWire final : public Wire {
public:
    /// Opens `path`, such as "/dev/hidraw0". If a claim on it is given, the claim is held until the
    /// wire is closed.
    [[nodiscard]] static Opened<std::unique_ptr<Wire>> open(const std::string& path,
                                                            std::optional<Claim> claim);

    [[nodiscard]] ReadResult read(std::span<std::byte> into) override;
    [[nodiscard]] TransferResult write(std::span<const std::byte> report) override;
    [[nodiscard]] TransferResult set_feature(std::span<const std::byte> report) override;
    [[nodiscard]] TransferResult get_feature(std::span<std::byte> report) override;

private:
    struct Close {
        void operator()(hid_device_* device) const;
    };
    using Handle = std::unique_ptr<hid_device_, Close>;

    HidrawWire(Handle handle, std::optional<Claim> claim)
        : claim_{std::move(claim)}, handle_{std::move(handle)}
    {}

    std::optional<Claim> claim_;
    Handle handle_;
};

} // namespace hapnet::device::hid

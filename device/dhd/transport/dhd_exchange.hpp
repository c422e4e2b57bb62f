// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/dhd/mapping.hpp"
#include "device/polled/exchange.hpp"

#include <optional>

namespace hapnet::device::dhd {

/// Exchanges data with an open device by the library's calls. The force is sent first, so that no
/// call that hangs before it can make it outdated. The destructor closes the device.
class DhdExchange final : public polled::Exchange {
public:
    DhdExchange(const Functions& functions, Id device) : functions_{functions}, device_{device} {}
    ~DhdExchange() override;
    DhdExchange(const DhdExchange&) = delete;
    DhdExchange& operator=(const DhdExchange&) = delete;

    [[nodiscard]] std::optional<polled::Report> tell(const polled::Command& command) override;

private:
    [[nodiscard]] int send(const polled::Command& command);
    [[nodiscard]] int receive(Reading& reading) const;

    Functions functions_;
    Id device_;
    Interpreter interpreter_;
    std::optional<bool> motors_on_{}; // state last set in the library; nullopt: none yet
};

} // namespace hapnet::device::dhd

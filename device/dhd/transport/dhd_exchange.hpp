// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/dhd/mapping.hpp"
#include "device/polled/exchange.hpp"

#include <optional>

namespace hapnet::device::dhd {

/// Exchanges with an open device by the library's calls, force first: so that what hangs in between
/// never leaves an old one to be sent. Closes the device at its end.
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
    std::optional<bool> motors_on_{}; // state that the library was told last; nullopt: none yet
};

} // namespace hapnet::device::dhd

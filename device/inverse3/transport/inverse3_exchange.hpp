// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/polled/exchange.hpp"
#include "proto/net/web_socket_client.hpp"

#include <optional>
#include <string>
#include <utility>

namespace hapnet::device::inverse3 {

/// Exchanges a force for a state with the service. An answer that arrives too late for its own
/// exchange is skipped in the next one.
class Inverse3Exchange final : public polled::Exchange {
public:
    Inverse3Exchange(net::WebSocketClient client, std::string id)
        : client_{std::move(client)}, id_{std::move(id)}
    {}

    [[nodiscard]] std::optional<polled::Report> tell(const polled::Command& command) override;

private:
    net::WebSocketClient client_;
    std::string id_;
};

} // namespace hapnet::device::inverse3

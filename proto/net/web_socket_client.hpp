// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::net {

/// A connection to a WebSocket on this machine (RFC 6455), for texts. Only one thread may use it.
/// No call waits longer than its limit. The connection is closed for good if the peer breaks the
/// protocol or sends a message beyond the limit.
class WebSocketClient {
public:
    struct Limits {
        base::Duration connect_max;
        std::size_t message_bytes_max = 65536;
    };

    /// Connects to 127.0.0.1:port and does the handshake for "/". The error names the port and the
    /// cause.
    [[nodiscard]] static base::Result<WebSocketClient> connect(std::uint16_t port,
                                                               const Limits& limits);
    ~WebSocketClient();
    WebSocketClient(WebSocketClient&& other) noexcept;
    WebSocketClient& operator=(WebSocketClient&& other) noexcept;
    WebSocketClient(const WebSocketClient&) = delete;
    WebSocketClient& operator=(const WebSocketClient&) = delete;

    /// Sends a text. Returns false if it was not sent completely within `most`. The connection is
    /// then closed, because half a message may have been sent.
    [[nodiscard]] bool send(std::string_view text, base::Duration most);
    /// Returns the next message; nullopt if none arrives within `most`.
    [[nodiscard]] std::optional<std::string> receive(base::Duration most);
    [[nodiscard]] bool is_open() const;

private:
    struct State;
    explicit WebSocketClient(std::unique_ptr<State> state);

    std::unique_ptr<State> state_;
};

} // namespace hapnet::net

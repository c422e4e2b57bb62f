// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/web_socket_client.hpp"

#include "proto/net/clock.hpp"

#include <algorithm>
#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/error.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::net {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using asio::ip::tcp;

} // namespace

struct WebSocketClient::State {
    asio::io_context context{1};
    websocket::stream<tcp::socket> stream{context};
    beast::flat_buffer incoming;
    bool is_reading = false;
    bool has_message = false;
    bool is_open = false;

    /// Runs pending operations until `done` is set or none is left, but no longer than `most`.
    void run_until(const bool& done, base::Duration most)
    {
        const base::TimePoint end = monotonic_now() + most;
        while (!done) {
            if (context.stopped()) context.restart();
            const base::Duration left = std::max(end - monotonic_now(), base::Duration{});
            if (context.run_one_for(left) == 0) return;
        }
    }

    /// Waits for one operation that `start` begins. The connection is closed if the operation times
    /// out or fails. Returns the cause.
    template <typename Start>
    beast::error_code finish(Start start, base::Duration most)
    {
        bool done = false;
        beast::error_code error;
        start([&](beast::error_code its_error) {
            error = its_error;
            done = true;
        });
        run_until(done, most);
        if (done && !error) return error;
        close();
        if (!done) {
            // The operation uses local variables of this function until it has ended.
            run_until(done, std::chrono::seconds{1});
            error = beast::error::timeout;
        }
        return error;
    }

    void close()
    {
        beast::error_code ignored;
        stream.next_layer().close(ignored);
        is_open = false;
    }

    /// Begins a read. One read is always pending.
    void read()
    {
        is_reading = true;
        stream.async_read(incoming, [this](beast::error_code error, std::size_t) {
            is_reading = false;
            has_message = !error;
            if (error) close();
        });
    }
};

base::Result<WebSocketClient> WebSocketClient::connect(std::uint16_t port, const Limits& limits)
{
    auto state = std::make_unique<State>();
    State& it = *state;
    const tcp::endpoint service{asio::ip::address_v4::loopback(), port};
    const auto refuse = [&](const beast::error_code& error) {
        return base::fail(fmt::format("127.0.0.1:{}: {}", port, error.message()));
    };
    tcp::socket& socket = it.stream.next_layer();
    if (const auto error =
            it.finish([&](auto handler) { socket.async_connect(service, std::move(handler)); },
                      limits.connect_max)) {
        return refuse(error);
    }
    beast::error_code error;
    socket.set_option(tcp::no_delay{true}, error);
    if (error) return refuse(error);
    it.stream.read_message_max(limits.message_bytes_max);
    const std::string host = fmt::format("127.0.0.1:{}", port);
    error =
        it.finish([&](auto handler) { it.stream.async_handshake(host, "/", std::move(handler)); },
                  limits.connect_max);
    if (error) return refuse(error);
    it.is_open = true;
    it.stream.text(true);
    it.read();
    return WebSocketClient{std::move(state)};
}

WebSocketClient::WebSocketClient(std::unique_ptr<State> state) : state_{std::move(state)} {}

WebSocketClient::~WebSocketClient() = default;

WebSocketClient::WebSocketClient(WebSocketClient&& other) noexcept = default;

WebSocketClient& WebSocketClient::operator=(WebSocketClient&& other) noexcept = default;

bool WebSocketClient::send(std::string_view text, base::Duration most)
{
    State& it = *state_;
    if (!it.is_open) return false;
    const auto error = it.finish(
        [&](auto handler) {
            it.stream.async_write(
                asio::buffer(text.data(), text.size()),
                [handler = std::move(handler)](beast::error_code its_error, std::size_t) mutable {
                    handler(its_error);
                });
        },
        most);
    return !error;
}

std::optional<std::string> WebSocketClient::receive(base::Duration most)
{
    State& it = *state_;
    if (it.is_open && !it.has_message) it.run_until(it.has_message, most);
    if (!it.has_message) return std::nullopt;
    it.has_message = false;
    std::string text = beast::buffers_to_string(it.incoming.data());
    it.incoming.consume(it.incoming.size());
    if (it.is_open) it.read();
    return text;
}

bool WebSocketClient::is_open() const { return state_->is_open; }

} // namespace hapnet::net

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/local/stream_protocol.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace hapnet::web {

/// A connection to a control socket that passes lines both ways. It retries until a program answers
/// there.
class Wire {
public:
    struct Handlers {
        std::function<void()> on_open;
        std::function<void(std::string_view line)> on_line;
        std::function<void(const std::string& why)> on_lost; // is also called if connecting failed
    };

    /// Longest line of a daemon of this project; a longer line breaks the connection.
    static constexpr std::size_t line_bytes_max = std::size_t{1} << 20;
    static constexpr std::size_t unsent_bytes_max = std::size_t{1} << 20;

    Wire(boost::asio::io_context& io, std::string path, Handlers handlers);
    ~Wire();
    Wire(const Wire&) = delete;
    Wire& operator=(const Wire&) = delete;

    /// Sends a line. Without a connection, the line is dropped.
    void send(const std::string& line);
    /// Breaks the connection and starts a new attempt.
    void lose(const std::string& why);

    [[nodiscard]] bool is_open() const { return is_open_; }

private:
    struct Alive {}; // by it late handlers see that the Wire is gone

    void connect();
    void connect_after(std::chrono::milliseconds time);
    void receive();
    void take_lines();
    void write();

    std::string path_;
    Handlers handlers_;
    boost::asio::io_context& io_;
    boost::asio::local::stream_protocol::socket socket_;
    boost::asio::steady_timer timer_;
    std::shared_ptr<Alive> alive_ = std::make_shared<Alive>();
    bool is_open_ = false;
    unsigned generation_ = 0; // number of the connection; handlers of older ones do nothing
    std::array<char, std::size_t{64} << 10> buffer_{};
    std::string input_;
    std::string unsent_;
    std::string sending_;
};

} // namespace hapnet::web

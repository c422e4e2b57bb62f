// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/wire.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <utility>

namespace hapnet::web {

namespace {

using namespace std::chrono_literals;
using boost::system::error_code;

constexpr auto connect_again_after = 200ms;

} // namespace

Wire::Wire(boost::asio::io_context& io, std::string path, Handlers handlers)
    : path_{std::move(path)}, handlers_{std::move(handlers)}, io_{io}, socket_{io}, timer_{io}
{
    connect_after({}); // not at once: the handlers' owner may still be under construction
}

Wire::~Wire()
{
    error_code ignored;
    socket_.close(ignored);
    timer_.cancel();
}

void Wire::connect()
{
    using Protocol = boost::asio::local::stream_protocol;
    socket_ = Protocol::socket{io_};
    const std::weak_ptr<Alive> alive = alive_;
    socket_.async_connect(Protocol::endpoint{path_},
                          [this, alive, mine = ++generation_](const error_code& error) {
                              if (alive.expired() || mine != generation_) return;
                              if (error) return lose(error.message());
                              is_open_ = true;
                              receive();
                              handlers_.on_open();
                          });
}

void Wire::connect_after(std::chrono::milliseconds time)
{
    const std::weak_ptr<Alive> alive = alive_;
    timer_.expires_after(time);
    timer_.async_wait([this, alive](const error_code& error) {
        if (!alive.expired() && !error) connect();
    });
}

void Wire::lose(const std::string& why)
{
    is_open_ = false;
    ++generation_;
    error_code ignored;
    socket_.close(ignored);
    input_.clear();
    unsent_.clear();
    sending_.clear();
    connect_after(connect_again_after);
    handlers_.on_lost(why);
}

void Wire::receive()
{
    const std::weak_ptr<Alive> alive = alive_;
    socket_.async_read_some(
        boost::asio::buffer(buffer_),
        [this, alive, mine = generation_](const error_code& error, std::size_t bytes) {
            if (alive.expired() || mine != generation_) return;
            if (error)
                return lose(error == boost::asio::error::eof ? "it has ended" : error.message());
            input_.append(buffer_.data(), bytes);
            take_lines();
            if (!alive.expired() && mine == generation_) receive();
        });
}

void Wire::take_lines()
{
    const std::weak_ptr<Alive> alive = alive_;
    const auto mine = generation_;
    std::size_t begin = 0;
    for (auto end = input_.find('\n'); end != std::string::npos; end = input_.find('\n', begin)) {
        const std::string line = input_.substr(begin, end - begin);
        begin = end + 1;
        handlers_.on_line(line);
        if (alive.expired() || mine != generation_) return;
    }
    input_.erase(0, begin);
    if (input_.size() > line_bytes_max) lose("it sends a line of more than 1 MiB");
}

void Wire::send(const std::string& line)
{
    if (!is_open_) return;
    if (unsent_.size() + line.size() > unsent_bytes_max) return lose("it reads nothing");
    unsent_ += line;
    unsent_ += '\n';
    if (sending_.empty()) write();
}

void Wire::write()
{
    sending_ = std::exchange(unsent_, {});
    const std::weak_ptr<Alive> alive = alive_;
    boost::asio::async_write(
        socket_, boost::asio::buffer(sending_),
        [this, alive, mine = generation_](const error_code& error, std::size_t /*bytes*/) {
            if (alive.expired() || mine != generation_) return;
            if (error) return lose(error.message());
            sending_.clear();
            if (!unsent_.empty()) write();
        });
}

} // namespace hapnet::web

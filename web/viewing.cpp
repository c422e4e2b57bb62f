// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/viewing.hpp"

#include "proto/control/core/request.hpp"
#include "proto/net/clock.hpp"

#include <algorithm>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>

namespace hapnet::web {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using namespace std::chrono_literals;
using Json = nlohmann::ordered_json;

constexpr std::size_t message_bytes_max = 256;
constexpr std::uint64_t unacknowledged_max = 8;
constexpr std::size_t unsent_bytes_max = std::size_t{16} << 20; // more than a whole history
constexpr auto token_within = 1s;
constexpr auto unread_max = 10s;

constexpr std::uint16_t close_wrong_token = 4401;
constexpr std::uint16_t close_too_late = 4408; // a busy page may try again
constexpr std::uint16_t close_too_many = 4429;

std::optional<std::uint64_t> acknowledged_in(const Json& message)
{
    const auto found = message.find("ack");
    if (message.size() != 1 || found == message.end() || !found->is_number_unsigned()) {
        return std::nullopt;
    }
    return found->get<std::uint64_t>();
}

class Viewing : public std::enable_shared_from_this<Viewing> {
public:
    Viewing(asio::ip::tcp::socket socket, const LiveParts& parts)
        : stream_{std::move(socket)},
          timer_{stream_.get_executor()},
          hub_{parts.hub},
          gate_{parts.gate}
    {}
    ~Viewing() = default;
    Viewing(const Viewing&) = delete;
    Viewing& operator=(const Viewing&) = delete;

    void begin(const Request& request, Visitors& visitors)
    {
        const std::weak_ptr<Viewing> weak = shared_from_this();
        visit_.emplace(visitors.admit({.is_idle = [] { return true; },
                                       .close =
                                           [weak] {
                                               if (const auto self = weak.lock()) self->cut();
                                           }}));
        stream_.read_message_max(message_bytes_max);
        stream_.set_option(websocket::stream_base::timeout{
            .handshake_timeout = 5s, .idle_timeout = 20s, .keep_alive_pings = true});
        stream_.text(true);
        stream_.async_accept(request, [self = shared_from_this()](beast::error_code error) {
            if (error) return;
            self->await_token();
            self->read();
        });
    }

private:
    void await_token()
    {
        timer_.expires_after(token_within);
        timer_.async_wait([self = shared_from_this()](beast::error_code error) {
            if (!error && !self->is_in_) self->close(close_too_late, "no token in time");
        });
    }

    void read()
    {
        stream_.async_read(
            buffer_, [self = shared_from_this()](beast::error_code error, std::size_t /*bytes*/) {
                if (error) return self->leave();
                const std::string text = beast::buffers_to_string(self->buffer_.data());
                self->buffer_.consume(self->buffer_.size());
                self->on_message(text);
                if (!self->is_closing_) self->read();
            });
    }

    void on_message(const std::string& text)
    {
        const auto message = control::parse_object(text);
        if (!message) return close(1008, "not a message of a page");
        if (!is_in_) return on_token(*message);
        if (const auto hand = hand_message_in(*message)) return hub_.hand(membership_->id(), *hand);
        const auto acknowledged = acknowledged_in(*message);
        if (!acknowledged || *acknowledged > sent_) return close(1008, "not a message of a page");
        acknowledged_ = std::max(acknowledged_, *acknowledged);
    }

    void on_token(const Json& message)
    {
        const auto token = message.find("token");
        if (message.size() != 1 || token == message.end() || !token->is_string() ||
            !gate_.is_token(token->get_ref<const std::string&>())) {
            return close(close_wrong_token, "a wrong token");
        }
        is_in_ = true;
        timer_.cancel();
        const std::weak_ptr<Viewing> weak = shared_from_this();
        auto joined = hub_.join({.tell =
                                     [weak](const Viewer::Text& message_text) {
                                         if (const auto self = weak.lock())
                                             self->push(message_text);
                                     },
                                 .frame =
                                     [weak](const std::string& body) {
                                         if (const auto self = weak.lock()) self->push_frame(body);
                                     }});
        if (!joined) return close(close_too_many, "too many pages look already");
        membership_.emplace(*std::move(joined));
        visit_.reset();
    }

    void push_frame(const std::string& body)
    {
        if (sent_ - acknowledged_ >= unacknowledged_max) {
            ++left_out_;
            if (!unsent_.empty() && net::monotonic_now() - last_progress_ > unread_max) cut();
            return;
        }
        push(std::make_shared<const std::string>(
            fmt::format("{{\"type\":\"frame\",\"n\":{},\"left_out\":{}{}", ++sent_,
                        std::exchange(left_out_, 0), body)));
    }

    void push(const Viewer::Text& text)
    {
        if (is_closing_) return;
        unsent_bytes_ += text->size();
        if (unsent_bytes_ > unsent_bytes_max) return cut();
        if (unsent_.empty()) last_progress_ = net::monotonic_now();
        unsent_.push_back(text);
        if (unsent_.size() == 1) write();
    }

    void write()
    {
        stream_.async_write(
            asio::buffer(*unsent_.front()),
            [self = shared_from_this()](beast::error_code error, std::size_t /*bytes*/) {
                if (error) return self->leave();
                self->last_progress_ = net::monotonic_now();
                self->unsent_bytes_ -= self->unsent_.front()->size();
                self->unsent_.pop_front();
                if (self->close_later_) return self->close_now();
                if (!self->unsent_.empty()) self->write();
            });
    }

    /// Closes with a reason when the present write is done: only one message is written at a time.
    void close(std::uint16_t code, const char* why)
    {
        if (is_closing_) return;
        is_closing_ = true;
        leave();
        close_later_ = websocket::close_reason{static_cast<websocket::close_code>(code), why};
        if (unsent_.empty()) close_now();
    }

    void close_now()
    {
        stream_.async_close(*close_later_, [self = shared_from_this()](beast::error_code) {});
    }

    void leave()
    {
        is_closing_ = true;
        timer_.cancel();
        membership_.reset();
    }

    /// Closes at once, without a message: the page does not read, or makes room for another
    /// visitor.
    void cut()
    {
        leave();
        beast::get_lowest_layer(stream_).close();
    }

    websocket::stream<beast::tcp_stream, /*deflate*/ false> stream_;
    asio::steady_timer timer_;
    Hub& hub_;
    const Gate& gate_;
    beast::flat_buffer buffer_;
    std::deque<Viewer::Text> unsent_; // the first is being written
    std::size_t unsent_bytes_ = 0;
    base::TimePoint last_progress_{};
    std::uint64_t sent_ = 0; // live frames sent
    std::uint64_t acknowledged_ = 0;
    std::uint64_t left_out_ = 0;
    std::optional<Visit> visit_;           // held until the page is a member
    std::optional<Membership> membership_; // membership of the hub
    bool is_in_ = false;
    bool is_closing_ = false;
    std::optional<websocket::close_reason> close_later_;
};

} // namespace

void view_live(asio::ip::tcp::socket socket, const Request& request, const LiveParts& parts)
{
    // The handshake answers from the request, which it reads at once.
    std::make_shared<Viewing>(std::move(socket), parts)->begin(request, parts.visitors);
}

} // namespace hapnet::web

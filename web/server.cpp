// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/server.hpp"

#include "proto/net/clock.hpp"
#include "web/core/visitors.hpp"
#include "web/viewing.hpp"

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <deque>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::web {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using namespace std::chrono_literals;

constexpr auto idle_max = 60s; // longest wait for the next request
constexpr auto sending_max = 5s;
constexpr auto answering_max = 30s; // long enough for a record of some megabytes

/// Sets the headers of every answer.
template <typename Message>
void secure(Message& message)
{
    message.set(http::field::server, "hapnet-web");
    message.set("Content-Security-Policy",
                "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data:; "
                "connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'");
    message.set("X-Content-Type-Options", "nosniff");
    message.set("Referrer-Policy", "no-referrer");
    message.set("Cross-Origin-Opener-Policy", "same-origin");
    message.set("Cross-Origin-Resource-Policy", "same-origin");
}

boost::string_view beast_view(std::string_view text) { return {text.data(), text.size()}; }

} // namespace

struct Server::State {
    Parts parts;
    Limits limits{};
    std::list<asio::ip::tcp::acceptor> acceptors;
    Visitors visitors{limits.connections};
    bool is_over = false;
    base::TimePoint second{};
    int posts = 0; // POST requests since `second`

    void accept(asio::ip::tcp::acceptor& acceptor, const std::shared_ptr<State>& self);
    [[nodiscard]] bool admits_post();
};

/// One browser's connection, until it ends or becomes a WebSocket. It counts as a visitor.
class Connection : public std::enable_shared_from_this<Connection> {
public:
    Connection(asio::ip::tcp::socket socket, std::shared_ptr<Server::State> state);

    /// Registers as a visitor and waits for a request.
    void begin();

private:
    void wait();
    void close();
    void read();
    void on_request();
    void upgrade();
    void serve();
    void serve_page();
    void serve_asset();
    void answer(const Reply& reply);
    void answer_file(const Reply& reply);
    void refuse(const Refusal& refusal);
    void refuse_bytes(const beast::error_code& error);
    /// Sends a message and keeps it until it is sent.
    template <typename Message>
    void send(std::shared_ptr<Message> message);

    beast::tcp_stream stream_;
    std::shared_ptr<Server::State> state_;
    beast::flat_buffer buffer_;
    std::optional<RequestParser> parser_;
    Request request_;
    std::optional<Visit> visit_;
    bool is_idle_ = true;
};

Connection::Connection(asio::ip::tcp::socket socket, std::shared_ptr<Server::State> state)
    : stream_{std::move(socket)},
      state_{std::move(state)},
      buffer_{state_->limits.request.header_bytes + state_->limits.request.body_bytes}
{}

void Connection::begin()
{
    const std::weak_ptr<Connection> weak = shared_from_this();
    visit_.emplace(state_->visitors.admit({.is_idle =
                                               [weak] {
                                                   const auto self = weak.lock();
                                                   return !self || self->is_idle_;
                                               },
                                           .close =
                                               [weak] {
                                                   if (const auto self = weak.lock()) self->close();
                                               }}));
    wait();
}

void Connection::wait()
{
    is_idle_ = true;
    if (buffer_.size() > 0) return read();
    stream_.expires_after(idle_max);
    stream_.async_read_some(buffer_.prepare(1024), [self = shared_from_this()](
                                                       beast::error_code error, std::size_t bytes) {
        if (error) return;
        self->buffer_.commit(bytes);
        self->read();
    });
}

void Connection::close()
{
    beast::error_code ignored;
    stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_both, ignored);
    stream_.close();
}

void Connection::read()
{
    is_idle_ = false;
    parser_.emplace();
    limit(*parser_, state_->limits.request);
    stream_.expires_after(sending_max);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t /*bytes*/) {
                         if (error) return self->refuse_bytes(error);
                         self->request_ = self->parser_->release();
                         self->on_request();
                     });
}

/// Answers bytes that are not a valid request with an error, and ends the connection.
void Connection::refuse_bytes(const beast::error_code& error)
{
    if (error == http::error::end_of_stream || error == beast::error::timeout ||
        error == asio::error::operation_aborted) {
        return close();
    }
    Refusal refusal{400, "not a request of HTTP/1.1"};
    if (error == http::error::header_limit) refusal = {431, "the header is above 8 KiB"};
    if (error == http::error::body_limit) refusal = {413, "the body is above 64 KiB"};
    request_ = {};
    request_.keep_alive(false);
    refuse(refusal);
}

void Connection::on_request()
{
    if (const auto refusal = state_->parts.gate.refuses(asked_of(request_))) {
        return refuse(*refusal);
    }
    if (is_upgrade(request_)) return upgrade();
    if (request_.method() == http::verb::post && !state_->admits_post()) {
        return refuse({429, "too many requests: 40 a second at most"});
    }
    serve();
}

void Connection::upgrade()
{
    if (state_->parts.hub.is_full()) return refuse({429, "too many pages look already"});
    visit_.reset(); // the WebSocket will be another visitor
    view_live(stream_.release_socket(), request_,
              {state_->parts.hub, state_->parts.gate, state_->visitors});
}

void Connection::serve()
{
    const auto path = path_of(view(request_.target()));
    if (path == "/") return serve_page();
    if (path.starts_with("/a/")) return serve_asset();
    stream_.expires_never(); // the hub answers in time
    state_->parts.hub.answer(path, request_.body(),
                             [self = shared_from_this()](const Reply& reply) {
                                 if (reply.file.empty()) return self->answer(reply);
                                 self->answer_file(reply);
                             });
}

void Connection::serve_page()
{
    auto message = std::make_shared<http::response<http::string_body>>();
    message->set(http::field::content_type, "text/html; charset=utf-8");
    message->set(http::field::cache_control, "no-cache");
    message->body() = state_->parts.page.index();
    send(std::move(message));
}

void Connection::serve_asset()
{
    const Asset* asset = state_->parts.page.find(path_of(view(request_.target())));
    if (asset == nullptr) return refuse({404, "there is no such file"});
    const std::string tag = "\"" + state_->parts.page.hash() + "\"";
    auto message = std::make_shared<http::response<http::span_body<const char>>>();
    message->set(http::field::content_type, beast_view(media_type(asset->name)));
    message->set(http::field::cache_control, "public, max-age=31536000, immutable");
    message->set(http::field::etag, tag);
    message->set(http::field::vary, "Accept-Encoding");
    if (request_[http::field::if_none_match] == tag) {
        message->result(http::status::not_modified);
        return send(std::move(message));
    }
    const bool takes_packed =
        request_[http::field::accept_encoding].find("gzip") != boost::string_view::npos;
    const bool is_packed = takes_packed && !asset->packed.empty();
    if (is_packed) message->set(http::field::content_encoding, "gzip");
    const std::string_view bytes = is_packed ? asset->packed : asset->bytes;
    message->body() = beast::span<const char>{bytes.data(), bytes.size()};
    send(std::move(message));
}

void Connection::answer(const Reply& reply)
{
    auto message = std::make_shared<http::response<http::string_body>>();
    message->result(static_cast<unsigned>(reply.status));
    message->set(http::field::content_type, reply.type);
    message->set(http::field::cache_control, "no-store");
    message->body() = reply.body;
    send(std::move(message));
}

void Connection::answer_file(const Reply& reply)
{
    auto message = std::make_shared<http::response<http::file_body>>();
    beast::error_code error;
    message->body().open(reply.file.c_str(), beast::file_mode::scan, error);
    if (error) return refuse({404, "the file is gone"});
    message->set(http::field::content_type, reply.type);
    message->set(http::field::cache_control, "no-store");
    message->set(http::field::content_disposition,
                 fmt::format("attachment; filename=\"{}\"", reply.attached_as));
    send(std::move(message));
}

void Connection::refuse(const Refusal& refusal)
{
    const Reply reply = error_reply(refusal.status, refusal.error);
    auto message = std::make_shared<http::response<http::string_body>>();
    message->result(static_cast<unsigned>(reply.status));
    message->set(http::field::content_type, reply.type);
    message->set(http::field::cache_control, "no-store");
    if (!refusal.allow.empty()) message->set(http::field::allow, beast_view(refusal.allow));
    message->body() = reply.body;
    send(std::move(message));
}

template <typename Message>
void Connection::send(std::shared_ptr<Message> message)
{
    message->version(11);
    message->keep_alive(request_.keep_alive());
    secure(*message);
    message->prepare_payload();
    const bool stays = message->keep_alive();
    stream_.expires_after(answering_max);
    const auto on_sent = [self = shared_from_this(), message, stays](beast::error_code error,
                                                                     std::size_t /*bytes*/) {
        if (error || !stays) return self->close();
        self->wait();
    };
    if (request_.method() == http::verb::head) {
        using Serializer = typename std::decay_t<decltype(*message)>;
        using Body = typename Serializer::body_type;
        auto header = std::make_shared<http::response_serializer<Body>>(*message);
        http::async_write_header(stream_, *header,
                                 [on_sent, header](beast::error_code error, std::size_t bytes) {
                                     on_sent(error, bytes);
                                 });
        return;
    }
    http::async_write(stream_, *message, on_sent);
}

void Server::State::accept(asio::ip::tcp::acceptor& acceptor, const std::shared_ptr<State>& self)
{
    acceptor.async_accept(
        [this, &acceptor, self](beast::error_code error, asio::ip::tcp::socket socket) {
            if (is_over || error == asio::error::operation_aborted) return;
            if (!error) {
                std::make_shared<Connection>(std::move(socket), self)->begin();
                return accept(acceptor, self);
            }
            // There may be no free descriptors. The next attempt waits a moment.
            auto timer = std::make_shared<asio::steady_timer>(parts.io, 100ms);
            timer->async_wait([this, &acceptor, self, timer](beast::error_code) {
                if (!is_over) accept(acceptor, self);
            });
        });
}

bool Server::State::admits_post()
{
    const auto now = net::monotonic_now();
    if (now - second >= 1s) {
        second = now;
        posts = 0;
    }
    return ++posts <= limits.posts_per_second;
}

Server::Server(const Parts& parts)
    : state_{std::make_shared<State>(State{.parts = parts, .acceptors = {}})}
{}

Server::~Server()
{
    state_->is_over = true;
    for (auto& acceptor : state_->acceptors) {
        beast::error_code ignored;
        acceptor.close(ignored);
    }
    state_->visitors.close_all();
}

void Server::accept_from(asio::ip::tcp::acceptor acceptor)
{
    auto& kept = state_->acceptors.emplace_back(std::move(acceptor));
    state_->accept(kept, state_);
}

} // namespace hapnet::web

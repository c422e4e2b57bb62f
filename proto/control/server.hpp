// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "proto/control/core/conversation.hpp"
#include "proto/net/unix_socket.hpp"
#include "proto/net/wait_set.hpp"

#include <array>
#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <utility>

namespace hapnet::control {

/// A control socket and its connected clients. Moves bytes between the clients and their
/// Conversations, a little in each call, so that the serving loop can do other work in between.
class Server {
public:
    static constexpr std::size_t clients_max = 16;
    /// The number of disconnected clients whose earlier requests are still carried out, a little at
    /// a time. Beyond it, the oldest requests are given up. A client that disconnects always frees
    /// its place at once.
    static constexpr std::size_t departed_max = 16;

    /// Limits of the work that clients can cause.
    struct Limits {
        std::size_t line_bytes = Conversation::line_bytes_max;
        int answers = 1; // most requests that one serve() answers
    };

    /// Throws std::system_error if the socket cannot be created.
    explicit Server(std::string path) : Server{std::move(path), Limits{}} {}
    Server(std::string path, const Limits& limits);

    /// Readable when serve() has something to do.
    [[nodiscard]] int descriptor() const { return wait_set_.descriptor(); }

    /// Returns when to call serve() again although descriptor() is not readable.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const;

    /// Does some of the pending work. It answers no more requests than the limits allow.
    void serve(const Subject& subject, base::TimePoint now);

private:
    struct Client {
        net::UnixStream stream;
        Conversation conversation;
        net::WaitSet::Interest interest;
    };

    void attend(const net::Ready& ready);
    void admit();
    /// Reads the client's input, as far as there is room for it.
    static net::Transfer::State take(Client& client);
    void answer_one(const Subject& subject, base::TimePoint now);
    static void send(Client& client, base::TimePoint now);
    void want(Client& client, std::size_t place);
    void let_go(Conversation conversation);

    net::UnixListener listener_;
    Limits limits_;
    net::WaitSet wait_set_;
    std::array<std::optional<Client>, clients_max> clients_;
    std::deque<Conversation> departed_; // disconnected clients with unfinished requests
    std::size_t turn_ = 0;              // index of the client that is served next
    bool has_more_ = false;             // a request may be waiting already
};

} // namespace hapnet::control

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/control/server.hpp"

#include "proto/control/core/reply.hpp"

#include <algorithm>
#include <span>
#include <tuple>
#include <utility>

namespace hapnet::control {

namespace {

constexpr std::size_t read_bytes_max = std::size_t{64} << 10;
constexpr std::size_t admitted_at_a_time = 4;

/// The listener's key in the wait set. The keys of the clients are their indices.
constexpr std::uint64_t listener_key = Server::clients_max;

} // namespace

Server::Server(std::string path, const Limits& limits) : listener_{std::move(path)}, limits_{limits}
{
    wait_set_.add(listener_.descriptor(), listener_key, {.to_read = true});
}

std::optional<base::TimePoint> Server::next_deadline() const
{
    if (has_more_) return base::TimePoint{};
    std::optional<base::TimePoint> next;
    for (const auto& client : clients_) {
        if (client) next = base::earlier(next, client->conversation.next_deadline());
    }
    return next;
}

void Server::serve(const Subject& subject, base::TimePoint now)
{
    bool is_somebody_new = false;
    for (const net::Ready& ready : wait_set_.ready()) {
        if (ready.key == listener_key) {
            is_somebody_new = true;
        } else {
            attend(ready);
        }
    }
    has_more_ = true;
    for (int i = 0; i < limits_.answers && has_more_; ++i) answer_one(subject, now);
    for (std::size_t place = 0; place < clients_max; ++place) {
        auto& client = clients_[place];
        if (!client) continue;
        send(*client, now);
        if (client->conversation.is_over() && client->conversation.output().empty()) {
            client.reset();
        } else if (client->conversation.is_gone()) {
            let_go(std::move(client->conversation));
            client.reset();
        } else {
            want(*client, place);
        }
    }
    if (is_somebody_new) admit(); // last, as clients that hung up have freed their places by now
}

void Server::attend(const net::Ready& ready)
{
    auto& client = clients_[ready.key];
    if (!client) return;
    const bool can_be_read = ready.is_readable && client->conversation.room() > 0;
    // Requests of a client that has disconnected may still be unread, so they are read first.
    if (can_be_read && take(*client) != net::Transfer::State::ended) return;
    if (ready.is_gone) client->conversation.on_gone();
}

void Server::admit()
{
    for (std::size_t i = 0; i < admitted_at_a_time; ++i) {
        auto stream = listener_.accept();
        if (!stream) return;
        const auto free = std::find_if(clients_.begin(), clients_.end(),
                                       [](const auto& client) { return !client; });
        if (free == clients_.end()) {
            std::ignore = stream->write(busy_refusal() + "\n");
            continue;
        }
        const auto place = static_cast<std::uint64_t>(free - clients_.begin());
        wait_set_.add(stream->descriptor(), place, {.to_read = true});
        free->emplace(
            Client{std::move(*stream), Conversation{limits_.line_bytes}, {.to_read = true}});
    }
}

net::Transfer::State Server::take(Client& client)
{
    std::array<char, read_bytes_max> buffer; // NOLINT(*-member-init): only what is read is used
    const auto room = std::min(buffer.size(), client.conversation.room());
    const auto taken = client.stream.read(std::span{buffer}.first(room));
    switch (taken.state) {
    case net::Transfer::State::moved:
        client.conversation.on_bytes({buffer.data(), taken.bytes});
        break;
    case net::Transfer::State::later: break;
    case net::Transfer::State::ended: client.conversation.on_end(); break;
    case net::Transfer::State::gone: client.conversation.on_gone(); break;
    }
    return taken.state;
}

void Server::answer_one(const Subject& subject, base::TimePoint now)
{
    has_more_ = false;
    for (std::size_t i = 0; i < clients_max && !has_more_; ++i) {
        auto& client = clients_[(turn_ + i) % clients_max];
        if (!client || !client->conversation.advance(subject, now)) continue;
        turn_ = (turn_ + i + 1) % clients_max;
        has_more_ = true;
    }
    if (has_more_ || departed_.empty()) return;
    departed_.front().advance(subject, now);
    if (departed_.front().is_over()) departed_.pop_front();
    has_more_ = !departed_.empty();
}

void Server::let_go(Conversation conversation)
{
    if (departed_.size() == departed_max) departed_.pop_front();
    departed_.push_back(std::move(conversation));
    has_more_ = true;
}

void Server::send(Client& client, base::TimePoint now)
{
    Conversation& conversation = client.conversation;
    if (conversation.output().empty()) return;
    const auto sent = client.stream.write(conversation.output());
    if (sent.state == net::Transfer::State::moved) {
        conversation.on_written(sent.bytes, now);
    } else if (sent.state != net::Transfer::State::later || conversation.is_stuck(now)) {
        conversation.on_gone();
    }
}

void Server::want(Client& client, std::size_t place)
{
    const net::WaitSet::Interest interest{.to_read = client.conversation.room() > 0,
                                          .to_write = !client.conversation.output().empty()};
    if (interest == client.interest) return;
    client.interest = interest;
    wait_set_.change(client.stream.descriptor(), place, interest);
}

} // namespace hapnet::control

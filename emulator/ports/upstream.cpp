// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/ports/upstream.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <system_error>
#include <utility>

namespace hapnet::emulator::ports {

namespace {

/// Where a client's socket to the server is bound: on loopback if the server is there.
net::Endpoint place_towards(const net::Endpoint& server)
{
    const bool is_v6 = server.family() == AF_INET6;
    const char* host =
        server.is_loopback() ? (is_v6 ? "::1" : "127.0.0.1") : (is_v6 ? "::" : "0.0.0.0");
    return net::resolve({host, 0}, server.family());
}

} // namespace

Upstream::Client::Client(std::uint64_t its_number, const net::Endpoint& its_address,
                         const ServerAndClients& places)
    : number{its_number},
      address{its_address},
      server{places.server},
      socket{place_towards(places.server), net::Load::bulk},
      local{socket.local()}
{}

Upstream::Upstream(ServerAndClients places, Setup setup, Paths& paths, Recorder& recorder)
    : places_{std::move(places)},
      setup_{setup},
      paths_{paths},
      recorder_{recorder},
      listening_{places_.listen, net::Load::bulk},
      local_{listening_.local()},
      table_{setup_.clients_max, setup_.idle},
      clients_(setup_.clients_max)
{
    own_.add(local_);
}

/// By address, a client that comes again is another one: "client.10.0.0.1:5000#2".
std::string Upstream::name_of(const Client& client)
{
    constexpr std::size_t remembered_max = 65'536;
    const auto number = fmt::format("{}", client.number);
    if (!setup_.named_by_address) return client_path(number);
    const auto address = client.address->to_text();
    if (visits_.size() >= remembered_max && !visits_.contains(address)) {
        return client_path(fmt::format("{}#{}", address, number));
    }
    const auto visit = ++visits_[address];
    return client_path(visit == 1 ? address : fmt::format("{}#{}", address, visit));
}

void Upstream::give_path(Client& client)
{
    client.name = name_of(client);
    client.path = &paths_.add(client.name);
    client.recorded_as = recorder_.add_path(client.name);
    own_.add(client.local);
}

void Upstream::turn_away(const net::Received& datagram, const std::string& why)
{
    if (!notice_.permits(datagram.at)) return;
    untold_ = fmt::format("{} sends to --listen {}: dropped, {}", datagram.from.to_text(),
                          local_.to_text(), why);
}

/// The client that sent it, which may be a new one; null: it is to be dropped.
Upstream::Client* Upstream::client_of(const net::Received& datagram)
{
    if (const auto known = table_.find(datagram.from, datagram.at)) return clients_[*known].get();
    if (own_.contains(datagram.from)) {
        ++strangers_;
        turn_away(datagram, "as it names the emulator's own address as its sender");
        return nullptr;
    }
    if (!places_.allowed.contains(datagram.from)) {
        ++strangers_;
        turn_away(datagram, "as --allow does not name it");
        return nullptr;
    }
    const auto place = table_.add(datagram.from, datagram.at);
    if (!place) {
        ++refused_;
        turn_away(datagram, fmt::format("as there are {} clients already: raise --clients, or "
                                        "lower --idle",
                                        table_.size_max()));
        return nullptr;
    }
    const auto number = table_.number(*place);
    auto& client = clients_[*place];
    try {
        client = std::make_unique<Client>(number, datagram.from, places_);
        answers_.add(client->socket.descriptor(), *place, {.to_read = true});
    } catch (const std::system_error& error) { // no descriptors, no ports
        client.reset();
        table_.forget(*place);
        ++refused_;
        turn_away(datagram, fmt::format("as the system has no socket for it: {}", error.what()));
        return nullptr;
    }
    give_path(*client);
    return client.get();
}

void Upstream::take_from_clients()
{
    const auto arrived = listening_.receive();
    std::optional<Batch> undelayed; // of one client after the other
    const Client* whose = nullptr;
    for (const net::Received& datagram : arrived) {
        Client* client = client_of(datagram);
        if (client == nullptr) continue;
        if (whose != client) {
            if (undelayed) undelayed->flush();
            undelayed.emplace(way(*client, Direction::up), to_server(*client));
            whose = client;
        }
        paths_.advance(datagram.at);
        undelayed->take(datagram, {CaptureSide::a, local_});
    }
    if (undelayed) undelayed->flush();
}

void Upstream::take_from_server(Client& client)
{
    Batch undelayed{way(client, Direction::down), to_client(client)};
    for (const net::Received& datagram : client.socket.receive()) {
        if (datagram.from != places_.server) {
            ++client.strangers;
            continue;
        }
        paths_.advance(datagram.at);
        undelayed.take(datagram, {CaptureSide::b, client.local});
    }
    undelayed.flush();
}

void Upstream::receive()
{
    take_from_clients();
    for (const net::Ready& ready : answers_.ready()) {
        if (auto& client = clients_[ready.key]) take_from_server(*client);
    }
}

void Upstream::release(base::TimePoint now)
{
    for (const auto& client : clients_) {
        if (!client) continue;
        send_due(way(*client, Direction::up), to_server(*client), way(*client, Direction::down),
                 to_client(*client), now);
    }
    forget_idle(now);
}

namespace {

bool has_nothing_in_flight(const EmulatedPath& path)
{
    return path.link(Direction::up).statistics().in_flight +
               path.link(Direction::down).statistics().in_flight ==
           0;
}

} // namespace

/// What is in flight is still delivered.
void Upstream::forget_idle(base::TimePoint now)
{
    for (std::size_t place = 0; place < clients_.size(); ++place) {
        auto& client = clients_[place];
        if (!client || now < table_.idle_at(place) || !has_nothing_in_flight(*client->path))
            continue;
        departed_.up.add(client->path->link(Direction::up).statistics());
        departed_.down.add(client->path->link(Direction::down).statistics());
        departed_.strangers_down += client->strangers;
        departed_.overflowed_down += client->socket.overflowed();
        ++forgotten_;
        own_.remove(client->local);
        paths_.remove(client->name);
        client.reset();
        table_.forget(place);
    }
}

std::optional<base::TimePoint> Upstream::next_deadline() const
{
    std::optional<base::TimePoint> next;
    for (std::size_t place = 0; place < clients_.size(); ++place) {
        const auto& client = clients_[place];
        if (!client) continue;
        if (has_nothing_in_flight(*client->path)) {
            next = base::earlier(next, table_.idle_at(place));
        }
    }
    return next;
}

std::optional<std::string> Upstream::next_notice() { return std::exchange(untold_, std::nullopt); }

} // namespace hapnet::emulator::ports

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

/// A client may have more than its part of the memory while others need less, and a few datagrams
/// in any case.
QueueLimits limits_of(const Upstream::Setup& setup)
{
    constexpr std::size_t parts = 4;
    constexpr std::size_t datagrams_min = 1024;
    const auto all = QueueLimits::within(setup.in_flight_bytes);
    const auto part = [&](std::size_t of, std::size_t least) {
        return std::min(of, std::max(least, of / setup.clients_max * parts));
    };
    return {.datagrams_max = part(all.datagrams_max, datagrams_min),
            .bytes_max = part(all.bytes_max, 16 * Slab::block_bytes)};
}

} // namespace

Upstream::Client::Client(std::uint64_t its_number, const net::Endpoint& its_address,
                         const Places& places, EmulatedPath its_path)
    : number{its_number},
      address{its_address},
      server{places.server},
      socket{place_towards(places.server), net::Load::bulk},
      local{socket.local()},
      path{std::move(its_path)}
{}

Upstream::Upstream(Places places, Setup setup, Recorder& recorder)
    : places_{std::move(places)},
      setup_{std::move(setup)},
      recorder_{recorder},
      slab_{std::make_shared<Slab>(setup_.in_flight_bytes)},
      listening_{places_.listen, net::Load::bulk},
      local_{listening_.local()},
      own_hosts_{net::addresses_of_this_machine()},
      table_{setup_.clients_max, setup_.idle},
      clients_(setup_.clients_max)
{}

EmulatedPath Upstream::path_of(std::uint64_t number) const
{
    return EmulatedPath{setup_.profile,
                        {.seed = setup_.seed,
                         .start = setup_.start,
                         .limits = limits_of(setup_),
                         .slab = slab_,
                         .name = fmt::format("client/{}", number)}};
}

/// Whether a datagram of this sender is forged, or our own that has come back: let in, it would go
/// round for ever.
bool Upstream::is_own(const net::Endpoint& from) const
{
    const auto port = from.port();
    const bool has_our_port =
        port == local_.port() || std::ranges::any_of(clients_, [&](const auto& client) {
            return client && client->local.port() == port;
        });
    return has_our_port && own_hosts_.contains(from);
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
    if (is_own(datagram.from)) {
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
        client = std::make_unique<Client>(number, datagram.from, places_, path_of(number));
        answers_.add(client->socket.descriptor(), *place, {.to_read = true});
    } catch (const std::system_error& error) { // no descriptors, no ports
        client.reset();
        table_.forget(*place);
        ++refused_;
        turn_away(datagram, fmt::format("as the system has no socket for it: {}", error.what()));
        return nullptr;
    }
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
        const auto admission = client->path.on_packet(Direction::up, datagram.bytes, datagram.at);
        if (!admission.departure) continue;
        if (whose != client) {
            if (undelayed) undelayed->flush();
            undelayed.emplace(client->path, Direction::up, to_server(*client), recorder_);
            whose = client;
        }
        undelayed->add(*admission.departure);
    }
    if (undelayed) undelayed->flush();
}

void Upstream::take_from_server(Client& client)
{
    Batch undelayed{client.path, Direction::down, to_client(client), recorder_};
    for (const net::Received& datagram : client.socket.receive()) {
        if (datagram.from != places_.server) {
            ++client.strangers;
            continue;
        }
        const auto admission = client.path.on_packet(Direction::down, datagram.bytes, datagram.at);
        if (admission.departure) undelayed.add(*admission.departure);
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

void Upstream::send_due_of(Client& client, base::TimePoint now)
{
    bool has_more_up = true;
    bool has_more_down = true;
    for (int round = 0; round < release_rounds_max && (has_more_up || has_more_down); ++round) {
        if (has_more_up) {
            has_more_up = send_due(client.path, Direction::up, to_server(client), recorder_, now);
        }
        if (has_more_down) {
            has_more_down =
                send_due(client.path, Direction::down, to_client(client), recorder_, now);
        }
    }
}

void Upstream::release(base::TimePoint now)
{
    for (const auto& client : clients_) {
        if (!client) continue;
        client->path.advance(now);
        send_due_of(*client, now);
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
        if (!client || now < table_.idle_at(place) || !has_nothing_in_flight(client->path))
            continue;
        departed_.up.add(client->path.link(Direction::up).statistics());
        departed_.down.add(client->path.link(Direction::down).statistics());
        departed_.strangers_down += client->strangers;
        departed_.overflowed_down += client->socket.overflowed();
        ++forgotten_;
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
        next = base::earlier(next, client->path.next_deadline());
        if (has_nothing_in_flight(client->path)) {
            next = base::earlier(next, table_.idle_at(place));
        }
    }
    return next;
}

std::optional<std::string> Upstream::next_notice() { return std::exchange(untold_, std::nullopt); }

} // namespace hapnet::emulator::ports
